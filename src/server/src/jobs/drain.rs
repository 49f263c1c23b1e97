//! Draining a process, and pausing the queue.

use std::sync::atomic::Ordering;

use super::queue::Jobs;
use super::store_error::StoreResult;

impl Jobs {
    /// Starts or stops draining: a draining process neither accepts nor starts jobs, but finishes those it has.
    pub fn set_draining(&self, draining: bool) {
        self.draining.store(draining, Ordering::Relaxed);
        tracing::info!(draining, "drain");
        self.wake_lanes();
    }

    /// Returns whether the process is draining.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }

    /// Pauses or resumes the queue: while it is paused, no process starts jobs, but all still accept them.
    pub async fn set_paused(&self, paused: bool) -> StoreResult<()> {
        self.store.set_paused(paused).await?;
        tracing::info!(paused, "pause");
        self.wake_lanes();
        Ok(())
    }

    /// Returns whether the queue is paused.
    pub async fn is_paused(&self) -> StoreResult<bool> {
        self.store.is_paused().await
    }

    /// Returns the number of jobs that this process is computing.
    pub fn running(&self) -> usize {
        self.running.heartbeats().len()
    }
}
