//! Limits per key: of concurrent items, and of requests per minute.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use axum::http::{HeaderMap, HeaderName, HeaderValue};

/// Number of items of each key.
#[derive(Debug)]
pub struct Crowds<K: Eq + Hash>(Mutex<HashMap<K, usize>>);

impl<K: Eq + Hash> Default for Crowds<K> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Clone + Eq + Hash> Crowds<K> {
    /// Adds an item of `who` and returns its seat; `None` if it already has `most`.
    pub fn enter(crowds: &Arc<Self>, who: K, most: Option<usize>) -> Option<Seat<K>> {
        let mut counts = crowds.0.lock().unwrap_or_else(PoisonError::into_inner);
        // A rejected key must not leave an entry behind.
        let count = counts.get(&who).copied().unwrap_or_default();
        if most.is_some_and(|most| most <= count) {
            return None;
        }
        counts.insert(who.clone(), count + 1);
        Some(Seat {
            crowds: Arc::clone(crowds),
            who,
        })
    }

    /// Returns whether no key has an item.
    pub fn is_empty(&self) -> bool {
        let counts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        counts.is_empty()
    }
}

/// An item, counted until it is dropped.
#[derive(Debug)]
pub struct Seat<K: Eq + Hash> {
    crowds: Arc<Crowds<K>>,
    who: K,
}

impl<K: Eq + Hash> Drop for Seat<K> {
    fn drop(&mut self) {
        let mut counts = (self.crowds.0.lock()).unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = counts.get_mut(&self.who) {
            *count -= 1;
            if *count == 0 {
                counts.remove(&self.who);
            }
        }
    }
}

// Rate limits per key in fixed windows of time.
//
// The windows are the same for all keys, so nothing is kept of past ones. Each process counts its own requests.

/// Length of a window: the options that set the limits count per minute.
const LENGTH: Duration = Duration::from_mins(1);

/// Headers with the limit and the rest of it (draft-ietf-httpapi-ratelimit-headers-10).
pub(super) const POLICY: HeaderName = HeaderName::from_static("ratelimit-policy");
pub(super) const LEFT: HeaderName = HeaderName::from_static("ratelimit");

/// Counts of each key in the current window.
pub(super) struct Windows<K> {
    most: u32,
    began: Instant,
    present: Mutex<PresentWindow<K>>,
}

struct PresentWindow<K> {
    window: u64,
    counts: HashMap<K, u32>,
}

/// State of a key in the current window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Standing {
    most: u32,
    left: u32,
    /// Seconds until the next window, at least one.
    pub reset: u64,
}

impl<K: Eq + Hash> Windows<K> {
    /// Allows each key `most` requests per window.
    pub fn of(most: u32) -> Self {
        let (window, counts) = (0, HashMap::new());
        Self {
            most,
            began: Instant::now(),
            present: PresentWindow { window, counts }.into(),
        }
    }

    /// Counts a request. Returns an error if it exceeds the limit.
    pub fn take(&self, key: K) -> Result<Standing, Standing> {
        let elapsed = self.began.elapsed();
        let mut present = (self.present.lock()).unwrap_or_else(PoisonError::into_inner);
        let window = elapsed.as_secs() / LENGTH.as_secs();
        if present.window != window {
            present.window = window;
            present.counts.clear();
        }
        let count = present.counts.entry(key).or_default();
        let is_allowed = *count < self.most;
        *count += u32::from(is_allowed);
        let standing = Standing {
            most: self.most,
            left: self.most - *count,
            reset: LENGTH.as_secs() - elapsed.as_secs() % LENGTH.as_secs(),
        };
        if is_allowed {
            Ok(standing)
        } else {
            Err(standing)
        }
    }
}

impl Standing {
    /// Sets the headers for the client.
    pub fn tell(self, headers: &mut HeaderMap) {
        let Self { most, left, reset } = self;
        let window = LENGTH.as_secs();
        let policy = format!("\"requests\";q={most};w={window}");
        let left = format!("\"requests\";r={left};t={reset}");
        for (name, text) in [(POLICY, policy), (LEFT, left)] {
            headers.extend(HeaderValue::from_str(&text).map(|value| (name, value)));
        }
    }
}
