//! Common arguments of `serve` and `worker`: locations of records and files, limits of jobs.

use std::time::Duration;

use super::store_args::StoreArgs;
use super::watch_args::WatchArgs;
use unwrapd_server::jobs::{self, Deployment, Program, Rules};
use unwrapd_worker::Computations;

/// Default memory limit of a job in bytes. A higher limit admits larger meshes, but jobs that run together may then
/// exhaust the machine.
pub(super) const JOB_MEMORY: u64 = 8 << 30;

/// Where records and files are, and what a job may use.
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
    pub fn settings(&self, program: Program) -> jobs::Settings {
        jobs::Settings {
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
    let read = |path| std::fs::read_to_string(path).unwrap_or_default();
    // Read the memory of the machine.
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
    // Read the limit of the container, of cgroup version 2 or 1. The word `max` does not parse and means no limit.
    let limit = |path| read(path).trim().parse().unwrap_or(u64::MAX);
    let container = limit("/sys/fs/cgroup/memory.max");
    let container = container.min(limit("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
    total.min(container)
}
