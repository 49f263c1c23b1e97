//! Housekeeping of the store: removal of expired jobs and of files without a job.

use std::sync::atomic::Ordering;
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::access::Visibility;
use super::identity::shared_identity;
use super::queue::Jobs;
use super::settings::Deployment;
use super::storage::{Reason, Sweep};
use super::store_error::{StoreError, StoreResult};
use super::transition::Command;

/// Number of searches for expired jobs per retention time, so that a job outlives it by a tenth at most.
const SEARCHES: u32 = 10;
/// Bounds on the time between searches: jobs outlive their retention by an hour at most, and searching more often
/// than once per second would keep the server busy.
const LONGEST_PAUSE: Duration = Duration::from_hours(1);
const SHORTEST_PAUSE: Duration = Duration::from_secs(1);
/// Minimum age of files without a job, and the interval between searches for them. Younger files may belong to a
/// submission under way in another process, whose clock may be hours ahead.
const SUBMISSION: Duration = Duration::from_hours(24);
/// Time for which the clock of the store must have advanced normally before anything expires. The retention time
/// applies if that is shorter. A longer time delays every removal after a start; a shorter one trusts a clock that
/// was set wrong sooner.
const STEADY: Duration = Duration::from_hours(1);

impl Jobs {
    /// Checks that records and files belong together, and cleans up after a start: empties the scratch folder. If
    /// this is the only process, also requeues its former jobs, removes jobs of requests that nobody waits for, and
    /// quarantines files without a job.
    pub async fn recover(&self) -> StoreResult<()> {
        let identity = shared_identity(self.store.as_ref(), self.blobs.as_ref()).await?;
        let _ = self.identity.set(identity);
        self.check_blobs().await?;
        // Empty the scratch folder.
        let scratch = &self.settings.scratch;
        if tokio::fs::try_exists(scratch).await? {
            let removed = tokio::fs::remove_dir_all(scratch).await;
            removed.map_err(StoreError::at(scratch))?;
        }
        let made = tokio::fs::create_dir_all(scratch).await;
        made.map_err(StoreError::at(scratch))?;
        // Without other processes, every running job and every waiting request is from before this start.
        if self.settings.deployment == Deployment::Embedded {
            self.sweep(Sweep::Abandoned).await?;
            for id in self.store.ephemeral().await? {
                self.command(&Visibility::All, id, Command::Cancel).await?;
                self.remove(&Visibility::All, id, Reason::Deleted).await?;
            }
            self.sweep_unknown_files(Duration::ZERO).await?;
        }
        Ok(())
    }

    /// Removes expired jobs and looks for files without a job, periodically until stopped.
    pub(super) async fn keep_until(&self, stop: &CancellationToken) {
        let retention = self.settings.retention.unwrap_or(Duration::MAX);
        let search = (retention / SEARCHES).clamp(SHORTEST_PAUSE, LONGEST_PAUSE);
        let mut interval = tokio::time::interval(search);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        // An embedded process has searched at its start.
        let is_only = self.settings.deployment == Deployment::Embedded;
        let mut looked = is_only.then(Instant::now);
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            // A draining process removes nothing.
            if self.is_draining() {
                continue;
            }
            // Search for files without a job once a day.
            if self.settings.retention.is_some() && looked.is_none_or(is_long_ago) {
                looked = Some(Instant::now());
                if let Err(error) = self.sweep_unknown_files(SUBMISSION).await {
                    tracing::warn!(%error, "files without a job not looked for");
                }
            }
            // Read the clock even if nothing expires: only regular readings reveal a jump.
            if let Err(error) = self.clock_is_steady().await {
                tracing::warn!(%error, "the clock of the store not looked at");
            }
            // Remove expired jobs.
            match self.remove_expired().await {
                Ok(0) => {}
                Ok(removed) => tracing::info!(removed, "expired jobs removed"),
                Err(error) => tracing::error!(%error, "expired jobs not removed"),
            }
        }
    }

    async fn remove_expired(&self) -> StoreResult<usize> {
        let mut removed = 0;
        let Some(retention) = self.settings.retention else {
            return Ok(removed);
        };
        if self.clock_is_steady().await? {
            self.store.forget_keys().await?;
        }
        loop {
            let ids = self.store.ended_before(retention).await?;
            // The clock may have jumped before it was asked which jobs have expired.
            if ids.is_empty() || !self.clock_is_steady().await? {
                return Ok(removed);
            }
            for id in ids {
                self.remove(&Visibility::All, id, Reason::Expired).await?;
                removed += 1;
            }
        }
    }

    /// Returns whether the clock of the store has advanced normally for long enough to trust it with expiry. Logs
    /// jumps and the first wait.
    pub(super) async fn clock_is_steady(&self) -> StoreResult<bool> {
        let wait = self.settings.retention.unwrap_or(STEADY).min(STEADY);
        let now = self.store.now().await?;
        let steadiness = self.clock.record(now, Instant::now());
        let is_steady = wait <= steadiness.steady;
        if let Some(jump_ms) = steadiness.jump_ms {
            tracing::warn!(
                jump_seconds = jump_ms / 1000,
                "the clock jumped: nothing expires before it has advanced normally for {wait:?}"
            );
        } else if !is_steady && !self.has_told_wait.swap(true, Ordering::Relaxed) {
            tracing::info!("nothing expires before the clock has advanced normally for {wait:?}");
        }
        Ok(is_steady)
    }
}

/// Returns whether it is time to look for files without a job again.
fn is_long_ago(last: Instant) -> bool {
    SUBMISSION <= last.elapsed()
}
