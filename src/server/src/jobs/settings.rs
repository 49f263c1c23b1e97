//! Limits of the queue and of jobs.

use std::path::PathBuf;
use std::time::Duration;

use super::child::Program;
use super::job::Rules;
use super::storage::OwnerQuotas;
use unwrapd_api::Catalog;

/// Presence of other processes on the same records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deployment {
    /// This is the only process.
    Embedded,
    /// There may be other processes, also on other machines.
    Shared,
}

impl Deployment {
    /// Returns the interval between heartbeats. It bounds the delay of progress shown by other processes, and of
    /// commands to the worker.
    pub(super) fn heartbeat_interval(self, rules: &Rules) -> Duration {
        match self {
            Self::Embedded => rules.lease / 3,
            Self::Shared => (rules.lease / 3).min(Duration::from_millis(400)),
        }
    }

    /// Returns the interval at which idle workers look for jobs, and at which records of watched jobs are polled.
    pub(super) fn poll_interval(self) -> Duration {
        match self {
            Self::Embedded => Duration::from_secs(1),
            Self::Shared => Duration::from_millis(400),
        }
    }
}

/// Limits of the queue and of each job.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Presence of other processes on the same records.
    pub deployment: Deployment,
    /// Rules for losing and retrying jobs.
    pub rules: Rules,
    /// Folder for uploads under way and for attempts. It belongs to this process alone and is emptied at startup.
    pub scratch: PathBuf,
    /// Program started as the compute child.
    pub program: Program,
    /// Catalog of computations that children offer.
    pub catalog: &'static dyn Catalog,
    /// Number of jobs that this process computes at a time.
    pub workers: usize,
    /// Cores that they share.
    pub cores: usize,
    /// Maximum number of jobs of one owner that run at a time, in all processes.
    pub owner_running: Option<u32>,
    /// Size in bytes up to which a job counts as small: one small job at a time may start although all `workers`
    /// slots are taken, so that it does not wait for large ones. `None` if small jobs wait like all others.
    pub small: Option<u64>,
    /// Maximum number of queued jobs.
    pub queue_depth: u32,
    /// Wall-clock time after which an attempt ends with its current map.
    pub time: Duration,
    /// Memory limit of a job in bytes.
    pub memory: u64,
    /// Maximum number of triangles of a mesh.
    pub triangles: u64,
    /// Maximum bytes of the files of all jobs together.
    pub quota: Option<u64>,
    /// Quotas of each owner.
    pub of_owner: OwnerQuotas,
    /// Bytes that must be free for a job to be accepted or started.
    pub min_free: u64,
    /// Time for which a job is kept after its end, with its files; `None` if another process takes care of that.
    pub retention: Option<Duration>,
    /// Time for which files without a job are kept before they are deleted.
    pub quarantine: Duration,
    /// Time for which attempts may continue after a stop, before their jobs are handed back.
    pub grace: Duration,
}

impl Settings {
    /// Returns the number of threads for a new attempt when `attempts` run here, including itself: cores / attempts,
    /// at least 1.
    pub fn threads(&self, attempts: usize) -> usize {
        (self.cores / attempts.max(1)).max(1)
    }
}
