//! When a computation is given up that does not end at its time limit.

use std::time::Duration;
use unwrapd_api::Failure;

/// How much longer than its limit a computation may take to end with the map it has: this share of
/// the limit, or this time if that is longer.
const GRACE_SHARE: f64 = 0.25;
const LEAST_GRACE: Duration = Duration::from_secs(10);

/// The time after which a computation with a time limit is terminated.
pub(super) fn given_up_after(limit: Duration) -> Duration {
    limit + limit.mul_f64(GRACE_SHARE).max(LEAST_GRACE)
}

/// What is said of it then.
pub(super) fn timed_out(limit: Duration) -> Failure {
    let seconds = limit.as_secs_f64();
    let detail = format!("no valid map within the time limit of {seconds} s");
    Failure::new("timed_out", detail)
}
