//! What is not kept: jobs long after their end, files without a job.

use std::time::Duration;

use tokio_util::sync::CancellationToken;

use super::queue::Jobs;
use super::storage::StoreResult;
use super::timestamp::Timestamp;

/// A job may outlive its time by this share of it,
const LATENESS: u32 = 10;
/// but not by more than an hour; a server that looks more often than every second does little else.
const LONGEST_PAUSE: Duration = Duration::from_hours(1);
const SHORTEST_PAUSE: Duration = Duration::from_secs(1);

impl Jobs {
    /// Removes jobs whose time is over, now and then, until told to stop.
    pub(super) async fn remove_expired_until(&self, stop: &CancellationToken) {
        let pause = (self.settings.retention / LATENESS).clamp(SHORTEST_PAUSE, LONGEST_PAUSE);
        loop {
            match self.remove_expired().await {
                Ok(0) => {}
                Ok(removed) => tracing::info!(removed, "jobs whose time was over"),
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
