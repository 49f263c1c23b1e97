//! Leases of workers on jobs, and the rules for retries.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use uuid::Uuid;

/// Id of one run of a worker process. It does not name a host, which may run several or come back as another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkerId(Uuid);

impl WorkerId {
    /// Creates an id that no worker had before.
    pub fn fresh() -> Self {
        Self(Uuid::now_v7())
    }
}

impl fmt::Display for WorkerId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for WorkerId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self)
    }
}

/// Fencing token of a job's holder. It rises whenever the job changes hands, so a former holder is recognized by its
/// lower number.
pub type Token = u64;

/// Rules for losing and retrying jobs.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// Time for which a lease lasts without a heartbeat.
    pub lease: Duration,
    /// Maximum number of attempts whose computation is killed, as for lack of memory, before the job fails.
    pub attempts: u32,
    /// Maximum number of attempts lost with their workers before the job fails. Jobs rarely kill workers, so this is
    /// much larger than `attempts`; but a job that kills every worker must end.
    pub interruptions: u32,
    /// Pause after the first lost attempt; it doubles with each further one.
    pub pause: Duration,
}

/// Upper bound of the pause. Doubled from one second, the twentieth would otherwise take six days.
const LONGEST_PAUSE: Duration = Duration::from_mins(5);
/// Number of lost workers after which a job is suspected of killing them. From then on a worker computes it alone, so
/// that it takes no other job down with it. One loss is usually an accident, such as a restart; a higher number puts
/// more innocent jobs at risk.
pub const SUSPECT: u32 = 2;

impl Default for Rules {
    fn default() -> Self {
        Self {
            lease: Duration::from_secs(15),
            attempts: 3,
            interruptions: 20,
            pause: Duration::from_secs(1),
        }
    }
}

impl Rules {
    /// Returns the pause after `lost` lost attempts, at least one.
    pub(super) fn pause_after(&self, lost: u32) -> Duration {
        let doubled = 1 << lost.saturating_sub(1).min(16);
        self.pause.saturating_mul(doubled).min(LONGEST_PAUSE)
    }

    /// Returns the longest pause under these rules.
    pub fn longest_pause(&self) -> Duration {
        self.pause_after(self.attempts.max(self.interruptions))
    }
}
