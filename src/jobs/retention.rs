//! What is not kept: jobs long after their end, files without a job.

use std::time::Duration;

use tokio_util::sync::CancellationToken;

use super::queue::Jobs;
use super::store_error::StoreResult;
use super::timestamp::Timestamp;

/// Searches for expired jobs per retention time: a job outlives it by a tenth at most,
const SEARCHES: u32 = 10;
/// and by no more than an hour. More than one search per second would keep the server busy.
const LONGEST_PAUSE: Duration = Duration::from_hours(1);
const SHORTEST_PAUSE: Duration = Duration::from_secs(1);

impl Jobs {
    /// Removes expired jobs from time to time until told to stop.
    pub(super) async fn remove_expired_until(&self, stop: &CancellationToken) {
        let pause = (self.settings.retention / SEARCHES).clamp(SHORTEST_PAUSE, LONGEST_PAUSE);
        loop {
            match self.remove_expired().await {
                Ok(0) => {}
                Ok(removed) => tracing::info!(removed, "expired jobs removed"),
                Err(error) => tracing::error!(%error, "expired jobs not removed"),
            }
            tokio::select! {
                () = tokio::time::sleep(pause) => {}
                () = stop.cancelled() => return,
            }
        }
    }

    async fn remove_expired(&self) -> StoreResult<usize> {
        let kept_ms = self.settings.retention.as_millis() as i64;
        let expired = Timestamp(Timestamp::now().0.saturating_sub(kept_ms));
        let jobs = self.store.ended_before(expired).await?;
        for &id in &jobs {
            self.remove(id).await?;
        }
        Ok(jobs.len())
    }

    /// Removes the files that a crash left between their storing and that of their job, or between its removal and
    /// theirs.
    pub(super) async fn remove_orphaned_files(&self) -> StoreResult<()> {
        for id in self.blobs.owners().await? {
            if self.store.get(id).await?.is_none() {
                tracing::info!(job = %id, "files without a job removed");
                self.blobs.remove(id).await?;
            }
        }
        Ok(())
    }
}
