//! Lanes of a process: slots for all jobs, and one reserved for small jobs.
//!
//! A small job that finds all slots taken would wait for a large one. It gets the reserved slot instead, and shares
//! the cores while it runs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tokio::sync::{Notify, Semaphore};

use super::settings::Settings;
use super::storage::Share;

/// Slots, and the jobs that may take them.
pub(super) struct Lane {
    pub slots: Arc<Semaphore>,
    pub share: Share,
    is_reserve: bool,
    /// Set while a free slot of the main lane waits for a job.
    is_any_free: Arc<AtomicBool>,
}

impl Lane {
    /// Returns the lanes of a process.
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

    /// Returns whether jobs may start in this lane now.
    pub fn is_open(&self) -> bool {
        !self.is_reserve || !self.is_any_free.load(Ordering::Relaxed)
    }

    /// Records whether a slot of this lane is free.
    pub fn set_free(&self, is_free: bool) {
        if !self.is_reserve {
            self.is_any_free.store(is_free, Ordering::Relaxed);
        }
    }

    /// Returns the notifier of this lane.
    pub fn bell<'a>(&self, main: &'a Notify, reserve: &'a Notify) -> &'a Notify {
        if self.is_reserve { reserve } else { main }
    }
}
