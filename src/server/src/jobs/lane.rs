//! Slots of a process: those for all jobs, and one in reserve for small ones.
//!
//! A small job that finds all slots taken would wait for a large one. It gets the slot in reserve
//! instead, and shares the cores for the time it takes.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tokio::sync::{Notify, Semaphore};

use super::settings::Settings;
use super::storage::Share;

/// Slots for jobs, and which jobs they are for.
pub(super) struct Lane {
    pub slots: Arc<Semaphore>,
    pub share: Share,
    is_reserve: bool,
    /// Whether a slot for all jobs is free, and one is looked for.
    is_any_free: Arc<AtomicBool>,
}

impl Lane {
    /// The lanes of a process.
    pub fn all(settings: &Settings) -> Vec<Self> {
        let is_any_free = Arc::new(AtomicBool::new(true));
        let share = Share {
            largest: None,
            of_owner: settings.owner_running,
            is_busy: false,
        };
        let small = settings.small.filter(|_| 0 < settings.workers);
        let reserve = small.map(|small| Self {
            slots: Arc::new(Semaphore::new(1)),
            share: Share {
                largest: Some(small),
                ..share
            },
            is_reserve: true,
            is_any_free: Arc::clone(&is_any_free),
        });
        let main = Self {
            slots: Arc::new(Semaphore::new(settings.workers)),
            share,
            is_reserve: false,
            is_any_free,
        };
        std::iter::once(main).chain(reserve).collect()
    }

    /// Whether jobs may start in it now.
    pub fn is_open(&self) -> bool {
        !self.is_reserve || !self.is_any_free.load(Ordering::Relaxed)
    }

    /// Says whether a slot of this lane is free.
    pub fn set_free(&self, is_free: bool) {
        if !self.is_reserve {
            self.is_any_free.store(is_free, Ordering::Relaxed);
        }
    }

    /// The one of two bells that rings for it.
    pub fn bell<'a>(&self, main: &'a Notify, reserve: &'a Notify) -> &'a Notify {
        if self.is_reserve { reserve } else { main }
    }
}
