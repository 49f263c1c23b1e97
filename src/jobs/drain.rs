//! A process that takes in no more work, but ends what it has.

use std::sync::atomic::Ordering;

use super::queue::Jobs;

impl Jobs {
    /// Takes in and starts no more jobs from now on, or does so again.
    pub fn set_draining(&self, draining: bool) {
        self.draining.store(draining, Ordering::Relaxed);
        tracing::info!(draining, "drain");
        self.wake.notify_one();
    }

    /// Whether it takes in no more jobs.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }

    /// Jobs that this process computes now.
    pub fn running(&self) -> usize {
        self.running.beats().len()
    }
}
