//! Whether the clock of the store can be trusted with what expires.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use tokio::time::Instant;

use super::timestamp::Timestamp;

/// How far the clock of the store may stray from the monotonic clock of this process between two
/// looks. Clocks that are steered stray by two seconds in an hour.
const TOLERANCE: Duration = Duration::from_mins(1);

/// Compares the clock of the store, which can be set, with the monotonic clock of this process,
/// which cannot. After a start and after every jump, it says for how long both have advanced alike.
#[derive(Debug, Default)]
pub struct SteadyClock {
    last: Mutex<Option<Look>>,
}

/// The clocks at one moment.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// Since when they have advanced alike.
    steady_since: Instant,
    at: Instant,
    time: Timestamp,
}

/// What a look at the clock tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steadiness {
    /// For how long the clock has advanced normally.
    pub steady: Duration,
    /// How far it has jumped since the last look, in milliseconds, if it has.
    pub jump_ms: Option<i64>,
}

impl SteadyClock {
    /// Notes that the clock of the store showed `time` at `at`.
    pub fn look(&self, time: Timestamp, at: Instant) -> Steadiness {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let jump_ms = last.and_then(|last| {
            let passed = at.saturating_duration_since(last.at);
            let jump_ms = time.0.saturating_sub(last.time.later(passed).0);
            (TOLERANCE.as_millis() < u128::from(jump_ms.unsigned_abs())).then_some(jump_ms)
        });
        let before = last.filter(|_| jump_ms.is_none());
        let steady_since = before.map_or(at, |last| last.steady_since);
        *last = Some(Look {
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
