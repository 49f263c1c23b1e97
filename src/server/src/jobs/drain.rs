//! A process that takes in no more work, but ends what it has; and a queue that waits.

use std::sync::atomic::Ordering;

use super::queue::Jobs;
use super::store_error::StoreResult;

impl Jobs {
    /// Takes in and starts no more jobs from now on, or does so again.
    pub fn set_draining(&self, draining: bool) {
        self.draining.store(draining, Ordering::Relaxed);
        tracing::info!(draining, "drain");
        self.look();
    }

    /// Whether it takes in no more jobs.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }

    /// Has no job started from now on, by any process, or again. Jobs are accepted all the same.
    pub async fn set_paused(&self, paused: bool) -> StoreResult<()> {
        self.store.set_paused(paused).await?;
        tracing::info!(paused, "pause");
        self.look();
        Ok(())
    }

    /// Whether no job is started.
    pub async fn is_paused(&self) -> StoreResult<bool> {
        self.store.is_paused().await
    }

    /// Jobs that this process computes now.
    pub fn running(&self) -> usize {
        self.running.beats().len()
    }
}
