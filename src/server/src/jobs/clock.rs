//! Detection of jumps of the store's clock, on which expiry depends.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use tokio::time::Instant;

use super::timestamp::Timestamp;

/// Maximum drift of the store's clock against the monotonic clock of this process between two readings. Disciplined
/// clocks drift by two seconds per hour at most, and readings are at most an hour apart.
const TOLERANCE: Duration = Duration::from_mins(1);

/// Compares the clock of the store, which can be set, with the monotonic clock of this process, which cannot. Reports
/// how long both have advanced alike since the start or the last jump.
#[derive(Debug, Default)]
pub struct SteadyClock {
    last: Mutex<Option<Reading>>,
}

/// Both clocks at one moment.
#[derive(Clone, Copy, Debug)]
struct Reading {
    /// Start of the period in which both have advanced alike.
    steady_since: Instant,
    at: Instant,
    time: Timestamp,
}

/// Result of a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steadiness {
    /// Time for which the store's clock has advanced normally.
    pub steady: Duration,
    /// Jump since the last reading, in milliseconds; `None` if there was none.
    pub jump_ms: Option<i64>,
}

impl SteadyClock {
    /// Records that the store's clock showed `time` at `at`.
    pub fn record(&self, time: Timestamp, at: Instant) -> Steadiness {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let jump_ms = last.and_then(|last| {
            let passed = at.saturating_duration_since(last.at);
            let jump_ms = time.0.saturating_sub(last.time.later(passed).0);
            (TOLERANCE.as_millis() < u128::from(jump_ms.unsigned_abs())).then_some(jump_ms)
        });
        let before = last.filter(|_| jump_ms.is_none());
        let steady_since = before.map_or(at, |last| last.steady_since);
        *last = Some(Reading {
            steady_since,
            at,
            time,
        });
        Steadiness {
            steady: at.saturating_duration_since(steady_since),
            jump_ms,
        }
    }
}
