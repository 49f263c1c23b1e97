//! Counts of concurrent items per key.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of items of each key.
pub(super) struct Crowds<K: Eq + Hash>(Mutex<HashMap<K, usize>>);

impl<K: Eq + Hash> Default for Crowds<K> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Clone + Eq + Hash> Crowds<K> {
    /// Adds an item of `who` and returns its seat; `None` if it already has `most`.
    pub fn enter(crowds: &Arc<Self>, who: K, most: Option<usize>) -> Option<Seat<K>> {
        let mut counts = crowds.0.lock().unwrap_or_else(PoisonError::into_inner);
        let count = counts.entry(who.clone()).or_default();
        if most.is_some_and(|most| most <= *count) {
            return None;
        }
        *count += 1;
        Some(Seat {
            crowds: Arc::clone(crowds),
            who,
        })
    }
}

/// An item, counted until it is dropped.
pub(super) struct Seat<K: Eq + Hash> {
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
