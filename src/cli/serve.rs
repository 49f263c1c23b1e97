//! `unwrapd serve`: settings, start and graceful stop of the service.

use std::fs::File;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};
use tokio_util::sync::CancellationToken;

use super::listen::Listen;
use crate::http;
use crate::jobs::{self, Jobs, LocalEvents};
use crate::store::{FileBlobs, SqliteStore};

/// Time for connections and computations to end after the stop signal.
const STOP_TIME: Duration = Duration::from_secs(10);

/// The arguments of `serve`. Each has an environment variable.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    listen: Listen,
    /// Folder for job records and files; created if missing
    #[arg(
        long,
        value_name = "DIR",
        env = "UNWRAPD_DATA",
        default_value = "./data"
    )]
    data: PathBuf,
    /// Number of jobs computed at the same time [default: half the cores, at least one]
    #[arg(long, value_name = "N", env = "UNWRAPD_CONCURRENCY", value_parser = clap::value_parser!(u16).range(1..))]
    concurrency: Option<u16>,
    /// Maximum number of queued jobs
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_QUEUE_DEPTH",
        default_value_t = 1000
    )]
    queue_depth: u32,
    /// Maximum size of an upload with all its files, in MiB
    #[arg(
        long,
        value_name = "MIB",
        env = "UNWRAPD_MAX_UPLOAD_MIB",
        default_value_t = 256
    )]
    max_upload_mib: u64,
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
    /// Wall-clock limit of a synchronous call, in seconds
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_SYNCHRONOUS_SECONDS",
        default_value_t = 60.0,
        value_parser = seconds
    )]
    synchronous_seconds: f64,
    /// Maximum size of the files of all jobs together, in MiB [default: no limit]
    #[arg(long, value_name = "MIB", env = "UNWRAPD_QUOTA_MIB")]
    quota_mib: Option<u64>,
    /// Free disk space below which no job is accepted or started, in MiB
    #[arg(
        long,
        value_name = "MIB",
        env = "UNWRAPD_MIN_FREE_MIB",
        default_value_t = 64
    )]
    min_free_mib: u64,
    /// Days to keep a job and its files after it ended
    #[arg(
        long,
        value_name = "DAYS",
        env = "UNWRAPD_RETAIN_DAYS",
        default_value_t = 30.0,
        value_parser = days
    )]
    retain_days: f64,
}

fn days(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(days) if (0.0..=1e6).contains(&days) => Ok(days),
        _ => Err("expected a number of days between 0 and 1000000".to_owned()),
    }
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.001..=1e6).contains(&seconds) => Ok(seconds),
        _ => Err("expected a number of seconds between 0.001 and 1000000".to_owned()),
    }
}

const DAY_SECONDS: f64 = 86_400.0;
/// Default memory of a job, in bytes.
pub(super) const JOB_MEMORY: u64 = 8 << 30;

impl Args {
    fn job_settings(&self) -> std::io::Result<jobs::Settings> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let concurrency = self.concurrency.map_or((cores / 2).max(1), usize::from);
        let memory = self.job_memory_mib.map(|mib| mib.saturating_mul(1 << 20));
        Ok(jobs::Settings {
            scratch: self.data.join("scratch"),
            program: std::env::current_exe()?,
            concurrency,
            threads: (cores / concurrency).max(1),
            queue_depth: self.queue_depth,
            time: Duration::from_secs_f64(self.job_seconds),
            memory: memory.unwrap_or_else(|| JOB_MEMORY.min(machine_memory())),
            triangles: self.max_triangles,
            quota: self.quota_mib.map(|mib| mib.saturating_mul(1 << 20)),
            min_free: self.min_free_mib.saturating_mul(1 << 20),
            retention: Duration::from_secs_f64(self.retain_days * DAY_SECONDS),
        })
    }

    fn http_settings(&self) -> http::Settings {
        http::Settings {
            upload_bytes: self.max_upload_mib.saturating_mul(1 << 20),
            synchronous_time: Duration::from_secs_f64(self.synchronous_seconds),
        }
    }
}

/// Memory of the machine or of the container, in bytes; `u64::MAX` if neither can be read.
pub(super) fn machine_memory() -> u64 {
    let read = |path| std::fs::read_to_string(path).unwrap_or_default();
    let total = read("/proc/meminfo")
        .lines()
        .find_map(|line| {
            line.strip_prefix("MemTotal:")?
                .strip_suffix("kB")?
                .trim()
                .parse::<u64>()
                .ok()
        })
        .map_or(u64::MAX, |kib| kib << 10);
    let container = read("/sys/fs/cgroup/memory.max")
        .trim()
        .parse()
        .unwrap_or(u64::MAX);
    total.min(container)
}

/// Serves until SIGTERM or SIGINT.
pub(super) fn run(args: &Args) -> Result<(), String> {
    tracing_subscriber::fmt()
        .with_env_filter(
            tracing_subscriber::EnvFilter::builder()
                .with_default_directive(tracing::Level::INFO.into())
                .from_env_lossy(),
        )
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .init();
    std::fs::create_dir_all(&args.data)
        .map_err(|error| format!("cannot create {}: {error}", args.data.display()))?;
    let _lock = lock(&args.data)?;
    tokio::runtime::Runtime::new()
        .map_err(|error| error.to_string())?
        .block_on(serve(args))
}

/// Two servers on one data folder would take each other's jobs. The lock goes with the process.
fn lock(data: &Path) -> Result<File, String> {
    let lock = File::create(data.join("lock")).map_err(|error| error.to_string())?;
    lock.try_lock()
        .map_err(|_| format!("another server uses {}", data.display()))?;
    Ok(lock)
}

async fn serve(args: &Args) -> Result<(), String> {
    let text = |error: &dyn std::fmt::Display| error.to_string();
    let store = SqliteStore::open(&args.data.join("unwrapd.sqlite"))
        .await
        .map_err(|e| text(&e))?;
    let blobs = FileBlobs::open(&args.data.join("blobs")).map_err(|e| text(&e))?;
    let settings = args.job_settings().map_err(|e| text(&e))?;
    let jobs = Arc::new(Jobs::new(
        settings,
        Arc::new(store),
        Arc::new(blobs),
        Arc::new(LocalEvents::default()),
    ));
    jobs.recover().await.map_err(|e| text(&e))?;

    let wished = args.listen.address;
    let listener = TcpListener::bind(wished)
        .await
        .map_err(|error| format!("cannot listen on {wished}: {error}"))?;
    let address = listener.local_addr().map_err(|e| text(&e))?;
    // A reader may have closed the pipe.
    let _ = writeln!(std::io::stdout(), "listening on http://{address}");

    let stop = CancellationToken::new();
    stop_on_signals(&stop).map_err(|e| text(&e))?;
    let queue = tokio::spawn(Arc::clone(&jobs).run(stop.clone()));
    let server = tokio::spawn(http::serve(
        listener,
        jobs,
        args.http_settings(),
        stop.clone(),
    ));
    stop.cancelled().await;
    tracing::info!("stopping");
    let all = async { (queue.await, server.await) };
    match tokio::time::timeout(STOP_TIME, all).await {
        Ok((Ok(()), Ok(served))) => served.map_err(|e| text(&e)),
        Ok((Err(error), _) | (_, Err(error))) => Err(text(&error)),
        Err(_) => {
            tracing::warn!("connections were still open");
            Ok(())
        }
    }
}

fn stop_on_signals(stop: &CancellationToken) -> std::io::Result<()> {
    for kind in [SignalKind::terminate(), SignalKind::interrupt()] {
        let (mut signals, stop) = (signal(kind)?, stop.clone());
        tokio::spawn(async move {
            signals.recv().await;
            stop.cancel();
        });
    }
    Ok(())
}
