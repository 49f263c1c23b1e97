//! Storage quotas, in total and per owner.

use std::time::Duration;

/// Limits on what may be stored.
#[derive(Clone, Copy, Debug)]
pub struct Capacity {
    /// Maximum number of queued jobs.
    pub depth: u32,
    /// Maximum bytes of all jobs' files, including those of the job to be accepted.
    pub bytes: Option<u64>,
    /// Quotas of each owner.
    pub of_owner: OwnerQuotas,
}

/// Quotas of one owner.
#[derive(Clone, Copy, Debug, Default)]
pub struct OwnerQuotas {
    /// Maximum number of queued and running jobs.
    pub jobs: Option<u32>,
    /// Maximum bytes of the files of all their jobs.
    pub bytes: Option<u64>,
    /// Maximum processor time per day in UTC.
    pub cpu_of_day: Option<Duration>,
}

/// Kind of quota of an owner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnerQuota {
    /// [`OwnerQuotas::jobs`].
    Jobs,
    /// [`OwnerQuotas::bytes`].
    Bytes,
    /// [`OwnerQuotas::cpu_of_day`].
    Cpu,
}
