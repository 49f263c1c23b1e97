//! Arguments for the limits of one owner.

use std::time::Duration;

use super::work_args::seconds;
use unwrapd_server::jobs::OwnerQuotas;

/// Limits of one owner. All keys of an owner count as one, so a key that replaces another adds
/// nothing. Without keys, all callers are one owner.
#[derive(clap::Args)]
#[command(next_help_heading = "Limits of one owner")]
#[expect(
    clippy::struct_field_names,
    reason = "they are the names of the options"
)]
pub(super) struct OwnerArgs {
    /// Maximum number of requests of one owner in a minute, as each process counts them [default: no
    /// limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_REQUESTS")]
    pub owner_requests: Option<u32>,
    /// Maximum number of queued and running jobs of one owner [default: no limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_JOBS")]
    owner_jobs: Option<u32>,
    /// Maximum size of the files of all jobs of one owner, in MiB [default: no limit]
    #[arg(long, value_name = "MIB", env = "UNWRAPD_OWNER_MIB")]
    owner_mib: Option<u64>,
    /// Processor time of the jobs of one owner on a day in UTC, in seconds; when it is used up, new
    /// jobs are refused [default: no limit]
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_OWNER_CPU_SECONDS",
        value_parser = seconds
    )]
    owner_cpu_seconds: Option<f64>,
    /// Maximum number of live sessions of one owner [default: half of `sessions`, rounded up; without
    /// keys, all callers are one owner, and have all]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_SESSIONS")]
    pub owner_sessions: Option<u16>,
}

impl OwnerArgs {
    /// Returns the quotas of one owner.
    pub fn quotas(&self) -> OwnerQuotas {
        OwnerQuotas {
            jobs: self.owner_jobs,
            bytes: self.owner_mib.map(|mib| mib.saturating_mul(1 << 20)),
            cpu_of_day: self.owner_cpu_seconds.map(Duration::from_secs_f64),
        }
    }
}
