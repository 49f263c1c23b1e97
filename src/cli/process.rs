//! A process that works on jobs, `serve` or `worker`: its arguments, log, folder, stores and shutdown.

use std::fs::File;
use std::io::IsTerminal;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use clap::ValueEnum;
use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};
use tokio_util::sync::CancellationToken;
use tracing_subscriber::EnvFilter;

use super::store_args::{StoreArgs, url_path};
use unwrapd_server::http::{Exposition, Measured, measure};
use unwrapd_server::jobs::{self, Blobs, Deployment, JobStore, Jobs, Program, Rules, Settings};
use unwrapd_server::sessions::Sessions;
use unwrapd_server::store::{RecordStore, blobs_at};
use unwrapd_worker::Computations;

/// Time for connections and computations to end after the stop signal and the grace period. A longer time delays the
/// exit if a client does not close its connection; a shorter one cuts off responses.
const STOP_TIME: Duration = Duration::from_secs(10);

/// Runs a process on its folder until it ends.
pub(super) fn run(
    args: &WorkArgs,
    process: impl Future<Output = Result<(), String>>,
) -> Result<(), String> {
    args.watch.start_log();
    args.store.make_folder()?;
    let _lock = lock(&args.store.data)?;
    tokio::runtime::Runtime::new()
        .map_err(|error| error.to_string())?
        .block_on(process)
}

/// Locks a data folder, so that no two processes use it. The lock is released when the process ends.
fn lock(data: &Path) -> Result<File, String> {
    let path = data.join("lock");
    let lock = File::create(&path)
        .map_err(|error| format!("cannot create {}: {error}", path.display()))?;
    lock.try_lock()
        .map_err(|_| format!("another server uses {}", data.display()))?;
    Ok(lock)
}

/// Returns the URL of file storage: the given one, or a part of the data folder.
pub(super) fn blobs_url(data: &Path, named: Option<&str>) -> Result<String, String> {
    match named {
        Some(blobs) => Ok(blobs.to_owned()),
        None => Ok(format!("file://{}", url_path(&data.join("blobs"))?)),
    }
}

/// Opens the stores, recovers the queue on them, and returns the queue and its records.
pub(super) async fn queue(
    args: &WorkArgs,
    settings: Settings,
) -> Result<(Arc<Jobs>, Arc<RecordStore>), String> {
    let blobs = blobs_url(&args.store.data, args.blobs.as_deref())?;
    let store = RecordStore::open(&args.store.database_url()?, settings.rules)
        .await
        .map_err(|error| format!("cannot use the database: {error}"))?;
    let store = Arc::new(store);
    let blobs: Arc<dyn Blobs> = blobs_at(&blobs)
        .map_err(|error| format!("cannot use the place for files: {error}"))?
        .into();
    let records: Arc<dyn JobStore> = Arc::clone(&store) as _;
    let jobs = Arc::new(Jobs::new(settings, records, blobs));
    jobs.recover().await.map_err(|error| error.to_string())?;
    Ok((jobs, store))
}

/// Returns a token that SIGTERM and SIGINT cancel.
pub(super) fn stop_on_signals() -> Result<CancellationToken, String> {
    let stop = CancellationToken::new();
    for kind in [SignalKind::terminate(), SignalKind::interrupt()] {
        let mut signals = signal(kind).map_err(|error| error.to_string())?;
        let stop = stop.clone();
        tokio::spawn(async move {
            signals.recv().await;
            stop.cancel();
        });
    }
    Ok(stop)
}

/// Waits for the end of a stopping process. Returns `None` if it exceeds its time limit.
pub(super) async fn stopped<T>(grace: Duration, all: impl Future<Output = T>) -> Option<T> {
    tracing::info!("stopping");
    tokio::time::timeout(grace + STOP_TIME, all).await.ok()
}

// Common arguments of `serve` and `worker`: locations of records and files, limits of jobs.

/// Default memory limit of a job in bytes. A higher limit admits larger meshes, but jobs that run together may then
/// exhaust the machine.
pub(super) const JOB_MEMORY: u64 = 8 << 30;

/// Locations of records and files, and limits of jobs.
#[derive(clap::Args)]
#[command(mut_arg("database", |database| database.requires("blobs")))]
pub(super) struct WorkArgs {
    #[command(flatten)]
    pub store: StoreArgs,
    #[command(flatten)]
    pub watch: WatchArgs,
    /// Place for files, shared with other processes: s3://BUCKET/PREFIX, or a mounted folder as
    /// file:///DIR. S3 is set up by environment variables: AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY,
    /// AWS_SESSION_TOKEN, AWS_REGION (us-east-1); AWS_ENDPOINT_URL names a server other than Amazon's,
    /// and needs AWS_ALLOW_HTTP=true if it begins with http://
    #[arg(
        long,
        value_name = "URL",
        env = "UNWRAPD_BLOBS_URL",
        requires = "database"
    )]
    pub blobs: Option<String>,
    /// Number of jobs computed at the same time by this process [default: the number of cores]. A job
    /// that begins while no other runs uses all cores
    #[arg(long, value_name = "N", env = "UNWRAPD_WORKERS")]
    pub workers: Option<u16>,
    /// Maximum number of jobs of one owner computed at the same time, by all processes together, which
    /// must have the same [default: no limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_RUNNING")]
    owner_running: Option<u32>,
    /// Size of small jobs, in KiB of all their files. One of them at a time starts even while all of
    /// `workers` are taken, so that it does not wait for large ones. 0: none does
    #[arg(
        long,
        value_name = "KIB",
        env = "UNWRAPD_SMALL_KIB",
        default_value_t = 256
    )]
    small_kib: u32,
    /// Maximum number of triangles of a mesh
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_MAX_TRIANGLES",
        default_value_t = 5_000_000
    )]
    max_triangles: u64,
    /// Time limit of a job, in seconds. When it is reached, the job ends with its current valid map.
    /// A job that has none is terminated after a quarter of the limit more, or 10 s if that is longer
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_JOB_SECONDS",
        default_value_t = 600.0,
        value_parser = seconds
    )]
    job_seconds: f64,
    /// Memory limit of a job, in MiB [default: 8192, or the memory of the machine if less]
    #[arg(long, value_name = "MIB", env = "UNWRAPD_JOB_MEMORY_MIB")]
    job_memory_mib: Option<u64>,
    /// Free disk space below which no job is accepted or started, in MiB
    #[arg(
        long,
        value_name = "MIB",
        env = "UNWRAPD_MIN_FREE_MIB",
        default_value_t = 64
    )]
    min_free_mib: u64,
    /// Number of attempts of a job whose computation is killed, as the system does for want of memory.
    /// Attempts that are lost with their worker count apart, up to 20; the pause after each doubles,
    /// from one second to five minutes. All processes must have the same
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_ATTEMPTS",
        default_value_t = 3,
        value_parser = clap::value_parser!(u32).range(1..=100)
    )]
    attempts: u32,
    /// Seconds of silence after which the job of a worker goes to another. All processes must have
    /// the same
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_LEASE_SECONDS",
        default_value_t = 15.0,
        value_parser = seconds
    )]
    lease_seconds: f64,
    /// Seconds that running jobs have to end after SIGTERM, before they go back to the queue
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_GRACE_SECONDS",
        default_value_t = 5.0,
        value_parser = seconds_or_none
    )]
    grace_seconds: f64,
}

/// Parses a number of seconds of an option.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.001..=1e6).contains(&seconds) => Ok(seconds),
        _ => Err("expected a number of seconds between 0.001 and 1000000".to_owned()),
    }
}

fn seconds_or_none(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..=1e6).contains(&seconds) => Ok(seconds),
        _ => Err("expected a number of seconds between 0 and 1000000".to_owned()),
    }
}

impl WorkArgs {
    /// Returns the number of jobs computed at a time.
    pub fn workers(&self) -> usize {
        self.workers.map_or_else(cores, usize::from)
    }

    /// Returns the memory limit of a job in bytes.
    pub fn memory(&self) -> u64 {
        let memory = self.job_memory_mib.map(|mib| mib.saturating_mul(1 << 20));
        memory.unwrap_or_else(|| JOB_MEMORY.min(machine_memory()))
    }

    /// Returns the settings of a process that computes jobs, but neither accepts nor removes any.
    pub fn settings(&self, program: Program) -> Settings {
        Settings {
            deployment: match self.store.database {
                None => Deployment::Embedded,
                Some(_) => Deployment::Shared,
            },
            rules: Rules {
                lease: Duration::from_secs_f64(self.lease_seconds),
                attempts: self.attempts,
                ..Rules::default()
            },
            scratch: self.store.data.join("scratch"),
            program,
            catalog: &Computations,
            workers: self.workers(),
            cores: cores(),
            owner_running: self.owner_running,
            small: (0 < self.small_kib).then(|| u64::from(self.small_kib) << 10),
            queue_depth: 0,
            time: Duration::from_secs_f64(self.job_seconds),
            memory: self.memory(),
            triangles: self.max_triangles,
            quota: None,
            of_owner: jobs::OwnerQuotas::default(),
            min_free: self.min_free_mib.saturating_mul(1 << 20),
            retention: None,
            quarantine: Duration::ZERO,
            grace: Duration::from_secs_f64(self.grace_seconds),
        }
    }
}

/// Returns the number of cores of the machine or of the container.
pub(super) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Returns the memory of the machine or of the container in bytes; `u64::MAX` if neither can be read.
pub(super) fn machine_memory() -> u64 {
    // Read the memory of the machine.
    let total = std::fs::read_to_string("/proc/meminfo")
        .unwrap_or_default()
        .lines()
        .find_map(|line| {
            line.strip_prefix("MemTotal:")?
                .strip_suffix("kB")?
                .trim()
                .parse::<u64>()
                .ok()
        })
        .map_or(u64::MAX, |kib| kib << 10);
    // Read the limit of the container, of cgroup version 2 or 1. The word `max` does not parse and means no limit.
    let limits = [
        "/sys/fs/cgroup/memory.max",
        "/sys/fs/cgroup/memory/memory.limit_in_bytes",
    ];
    limits.into_iter().fold(total, |least, path| {
        let limit = std::fs::read_to_string(path).unwrap_or_default();
        least.min(limit.trim().parse().unwrap_or(u64::MAX))
    })
}

// Arguments for logs and metrics.

/// Log and metrics of a process.
#[derive(clap::Args)]
#[command(next_help_heading = "Log and metrics")]
pub(super) struct WatchArgs {
    /// Level of the log, such as `warn`, or levels by part, such as `info,unwrapd_server::jobs=debug`
    #[arg(
        long,
        value_name = "LEVELS",
        env = "UNWRAPD_LOG",
        default_value = "info",
        value_parser = levels
    )]
    log: String,
    /// Format of the log, which goes to standard error
    #[arg(
        long,
        value_name = "FORMAT",
        env = "UNWRAPD_LOG_FORMAT",
        default_value = "text"
    )]
    log_format: LogFormat,
    /// Address at which anybody may get /metrics without a key [default: none; `serve` has them at
    /// its own address, for keys with the scope admin]
    #[arg(long, value_name = "ADDRESS", env = "UNWRAPD_METRICS_LISTEN")]
    metrics_listen: Option<SocketAddr>,
}

/// Format of the log's lines.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum LogFormat {
    /// For people.
    Text,
    /// An object per line.
    Json,
}

fn levels(text: &str) -> Result<String, String> {
    let read = EnvFilter::builder().parse(text);
    read.map(|_| text.to_owned())
        .map_err(|error| format!("expected levels such as warn or unwrapd=debug: {error}"))
}

/// Installs the metrics. Called first, so that nothing recorded at startup is lost.
pub(super) fn measured() -> Result<Measured, String> {
    measure().map_err(|error| format!("nothing is measured: {error}"))
}

impl WatchArgs {
    /// Starts the log.
    pub fn start_log(&self) {
        let log = tracing_subscriber::fmt()
            .with_env_filter(EnvFilter::new(&self.log))
            .with_writer(std::io::stderr);
        match self.log_format {
            LogFormat::Text => log.with_ansi(std::io::stderr().is_terminal()).init(),
            LogFormat::Json => log.json().flatten_event(true).init(),
        }
    }

    /// Serves the metrics at their address, if one is given, until told to stop.
    pub async fn exposition(
        &self,
        measured: Measured,
        jobs: Arc<Jobs>,
        sessions: Option<Arc<Sessions>>,
        stop: &CancellationToken,
    ) -> Result<Exposition, String> {
        let exposition = Exposition::new(measured, jobs, sessions);
        if let Some(address) = self.metrics_listen {
            let listener = listener(address).await?;
            tokio::spawn(exposition.clone().serve(listener, stop.clone()));
        }
        let (kept, stop) = (exposition.clone(), stop.clone());
        tokio::spawn(async move { kept.keep_until(stop).await });
        Ok(exposition)
    }
}

// The listening address: an option of `serve`, and a file for `health`.

/// Name of the file in the data folder that contains the address.
pub(super) const ADDRESS_FILE: &str = "address";

/// Listens at an address.
pub(super) async fn listener(address: SocketAddr) -> Result<TcpListener, String> {
    let listener = TcpListener::bind(address).await;
    listener.map_err(|error| format!("cannot listen on {address}: {error}"))
}

/// The address of the service.
#[derive(clap::Args)]
pub(super) struct Listen {
    /// Address to listen on. Port 0 selects a free port; `0.0.0.0` and `[::]` listen on all
    /// interfaces
    #[arg(
        long = "listen",
        value_name = "ADDRESS",
        env = "UNWRAPD_LISTEN",
        default_value = "127.0.0.1:8080"
    )]
    pub address: SocketAddr,
}
