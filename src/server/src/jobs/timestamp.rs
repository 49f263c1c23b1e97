//! Timestamps in UTC, to the millisecond, and jumps of the store's clock.

use std::fmt;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde::{Serialize, Serializer};
use tokio::time::Instant;

/// Milliseconds per day.
const DAY_MS: i64 = 86_400_000;

/// Milliseconds since 1970-01-01T00:00:00Z; shown and serialized as RFC 3339.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Timestamp(pub i64);

impl Timestamp {
    /// Returns the time of the system clock.
    pub fn now() -> Self {
        SystemTime::now().into()
    }

    /// Returns the time later by this duration.
    #[must_use]
    pub fn later(self, by: Duration) -> Self {
        Self(self.0.saturating_add(by.as_millis() as i64))
    }

    /// Returns the time left until the next day in UTC.
    pub(super) fn until_next_day(self) -> Duration {
        Duration::from_millis((DAY_MS - self.0.rem_euclid(DAY_MS)) as u64)
    }

    /// Returns the milliseconds since an earlier time; 0 if it is later.
    pub fn since(self, earlier: Self) -> u64 {
        (self.0 - earlier.0).max(0) as u64
    }
}

impl From<SystemTime> for Timestamp {
    fn from(time: SystemTime) -> Self {
        let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
        Self(since.as_millis() as i64)
    }
}

impl fmt::Display for Timestamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (year, month, day) = civil_date(self.0.div_euclid(DAY_MS));
        let ms = self.0.rem_euclid(DAY_MS);
        let (hour, minute, second) = (ms / 3_600_000, ms / 60_000 % 60, ms / 1000 % 60);
        let milli = ms % 1000;
        write!(
            f,
            "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{milli:03}Z"
        )
    }
}

/// Converts a day number counted from 1970-01-01 to year, month and day of the Gregorian calendar.
///
/// Counts in eras of 400 years (146,097 days) that begin on 1 March, so that the leap day is a year's last.
fn civil_date(day: i64) -> (i64, i64, i64) {
    let shifted = day + 719_468;
    let era = shifted.div_euclid(146_097);
    let day_of_era = shifted.rem_euclid(146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let march_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * march_month + 2) / 5 + 1;
    let month = if march_month < 10 {
        march_month + 3
    } else {
        march_month - 9
    };
    let year = year_of_era + era * 400 + i64::from(month <= 2);
    (year, month, day)
}

impl Serialize for Timestamp {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

// Detection of jumps of the store's clock, on which expiry depends.

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
