//! How much may be stored, in all and of one owner.

use std::time::Duration;

/// How much may be stored.
#[derive(Clone, Copy, Debug)]
pub struct Capacity {
    /// Jobs that may wait.
    pub depth: u32,
    /// Bytes that the files of all jobs may take when one more is accepted.
    pub bytes: Option<u64>,
    /// What one owner may have.
    pub of_owner: OwnerQuotas,
}

/// What one owner may have.
#[derive(Clone, Copy, Debug, Default)]
pub struct OwnerQuotas {
    /// Jobs that wait or run.
    pub jobs: Option<u32>,
    /// Bytes of the files of all their jobs.
    pub bytes: Option<u64>,
    /// Processor time of a day in UTC.
    pub cpu_of_day: Option<Duration>,
}

/// A quota of an owner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnerQuota {
    /// [`OwnerQuotas::jobs`].
    Jobs,
    /// [`OwnerQuotas::bytes`].
    Bytes,
    /// [`OwnerQuotas::cpu_of_day`].
    Cpu,
}
