//! Who works on a job, for how long without a sign of life, and how often.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use uuid::Uuid;

/// Names one run of a worker process: never a host, which may run several or come back as another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkerId(Uuid);

impl WorkerId {
    /// A name that nobody had before.
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

/// Names one holder of a job. It rises whenever the job changes hands, so a former holder is known
/// by its lower number.
pub type Token = u64;

/// When a job changes hands, and how often it may.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// How long a worker may be silent.
    pub lease: Duration,
    /// Attempts whose computation may be killed, as for want of memory, before the job fails.
    pub attempts: u32,
    /// Attempts that may be lost with their workers before the job fails. A worker rarely dies of a
    /// job, so these are many more; but one that kills every worker must end.
    pub interruptions: u32,
    /// Pause after the first lost attempt; it doubles with each further one.
    pub pause: Duration,
}

/// No pause is longer: the twentieth would take a week.
const LONGEST_PAUSE: Duration = Duration::from_mins(5);
/// A job that was lost with so many workers may be what kills them. From then on it is computed by
/// a worker that computes nothing else meanwhile, so that it takes no other job down with it.
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
    /// Pause after so many lost attempts, at least one.
    pub(super) fn pause_after(&self, lost: u32) -> Duration {
        let doubled = 1 << lost.saturating_sub(1).min(16);
        self.pause.saturating_mul(doubled).min(LONGEST_PAUSE)
    }

    /// No pause is longer.
    pub fn longest_pause(&self) -> Duration {
        self.pause_after(self.attempts.max(self.interruptions))
    }
}
