//! What a job may use.

use std::path::PathBuf;
use std::time::Duration;

use super::lease::Rules;
use super::program::Program;
use super::quotas::OwnerQuotas;
use unwrapd_api::Catalog;

/// Whether there are other processes on the same records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deployment {
    /// This is the only one.
    Embedded,
    /// There may be others, on other machines.
    Shared,
}

impl Deployment {
    /// How often a worker gives a sign of life. Others see its progress, and it hears their
    /// wishes, no sooner.
    pub(super) fn beat_interval(self, rules: &Rules) -> Duration {
        match self {
            Self::Embedded => rules.lease / 3,
            Self::Shared => (rules.lease / 3).min(Duration::from_millis(400)),
        }
    }

    /// How often an idle worker looks for jobs that nobody told it of, and a process at the
    /// records of watched jobs.
    pub(super) fn look_interval(self) -> Duration {
        match self {
            Self::Embedded => Duration::from_secs(1),
            Self::Shared => Duration::from_millis(400),
        }
    }
}

/// Limits of the queue and of each job.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Who else uses the records.
    pub deployment: Deployment,
    /// When a job changes hands.
    pub rules: Rules,
    /// Folder for what is in the making: uploads being received and the folders of attempts. It is
    /// of this process alone, and emptied at the start.
    pub scratch: PathBuf,
    /// What is started as compute child.
    pub program: Program,
    /// What children can compute.
    pub catalog: &'static dyn Catalog,
    /// Jobs that this process computes at the same time.
    pub workers: usize,
    /// Cores that they share.
    pub cores: usize,
    /// Jobs of one owner that are computed at the same time, in all processes.
    pub owner_running: Option<u32>,
    /// Jobs with files of at most so many bytes may also start while all of `workers` are taken, one
    /// at a time: they do not wait for large ones. `None`: they wait like all others.
    pub small: Option<u64>,
    /// Jobs that may wait.
    pub queue_depth: u32,
    /// Wall-clock time after which an attempt ends with the map it has.
    pub time: Duration,
    /// Memory of a job, in bytes.
    pub memory: u64,
    /// Triangles of a mesh.
    pub triangles: u64,
    /// Bytes that the files of all jobs may take together.
    pub quota: Option<u64>,
    /// What one owner may have.
    pub of_owner: OwnerQuotas,
    /// Bytes that must be free for a job to be accepted or started.
    pub min_free: u64,
    /// How long a job is kept after its end, with its files. `None`: another process sees to that.
    pub retention: Option<Duration>,
    /// How long files without a job are kept before they are deleted.
    pub quarantine: Duration,
    /// How long attempts may go on after a stop, before their jobs are handed back.
    pub grace: Duration,
}

impl Settings {
    /// Threads of an attempt that begins when so many run here, itself included: one that is alone
    /// has all cores, and where each core has its attempt, none takes a second one.
    pub fn threads(&self, attempts: usize) -> usize {
        (self.cores / attempts.max(1)).max(1)
    }
}
