//! Termination of computations that overrun their time limit.

use std::time::Duration;
use unwrapd_api::Failure;

/// Grace period after the time limit for a computation to end with its current map: this share of the limit, but at
/// least `LEAST_GRACE`. A longer period lets a hanging computation occupy its slot; a shorter one discards valid
/// maps. `tests/bench/ends.rs` measures how long an early end takes.
const GRACE_SHARE: f64 = 0.25;
const LEAST_GRACE: Duration = Duration::from_secs(10);

/// Returns the time after which a computation with a time limit is terminated.
pub(super) fn given_up_after(limit: Duration) -> Duration {
    limit + limit.mul_f64(GRACE_SHARE).max(LEAST_GRACE)
}

/// Returns the failure of a computation that was terminated.
pub(super) fn timed_out(limit: Duration) -> Failure {
    let seconds = limit.as_secs_f64();
    let detail = format!("no valid map within the time limit of {seconds} s");
    Failure::new("timed_out", detail)
}
