//! The store kept in order: jobs of silent workers, jobs whose time is over, files without a job.

use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::queue::Jobs;
use super::settings::Deployment;
use super::state::State;
use super::storage::{Reason, Sweep};
use super::store_error::StoreResult;
use super::timestamp::Timestamp;
use super::transition::Wish;

/// Sweeps per lease: a job is taken from a silent worker that much later at most.
const SWEEPS: u32 = 3;
/// Searches for expired jobs per retention time: a job outlives it by a tenth at most,
const SEARCHES: u32 = 10;
/// and by no more than an hour. More than one search per second would keep the server busy.
const LONGEST_PAUSE: Duration = Duration::from_hours(1);
const SHORTEST_PAUSE: Duration = Duration::from_secs(1);
/// Files whose job is younger may belong to a submission under way in another process.
const SUBMISSION_MS: u64 = 3_600_000;

impl Jobs {
    /// Puts the house in order after a start: scratch is emptied. What the only process left behind
    /// goes back to the queue, calls that nobody waits for any more are forgotten, and files
    /// without a job are removed.
    pub async fn recover(&self) -> StoreResult<()> {
        let scratch = &self.settings.scratch;
        if tokio::fs::try_exists(scratch).await? {
            tokio::fs::remove_dir_all(scratch).await?;
        }
        tokio::fs::create_dir_all(scratch).await?;
        if self.settings.deployment == Deployment::Embedded {
            self.sweep(Sweep::Abandoned).await?;
            for id in self.store.ephemeral().await? {
                self.wish(id, Wish::Cancel).await?;
                self.remove(id, Reason::Deleted).await?;
            }
            self.remove_orphaned_files().await?;
        }
        Ok(())
    }

    /// Sweeps and removes expired jobs from time to time until told to stop.
    pub(super) async fn keep_until(&self, stop: &CancellationToken) {
        let retention = self.settings.retention.unwrap_or(Duration::MAX);
        let search = (retention / SEARCHES).clamp(SHORTEST_PAUSE, LONGEST_PAUSE);
        let pace = (self.settings.rules.lease / SWEEPS).min(search);
        let mut interval = tokio::time::interval(pace);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut searched: Option<Instant> = None;
        if self.settings.deployment == Deployment::Shared
            && self.settings.retention.is_some()
            && let Err(error) = self.remove_orphaned_files().await
        {
            tracing::warn!(%error, "files without a job not looked for");
        }
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            if let Err(error) = self.sweep(Sweep::Overdue).await {
                tracing::error!(%error, "jobs of silent workers not looked for");
            }
            if searched.is_some_and(|last| last.elapsed() < search) {
                continue;
            }
            searched = Some(Instant::now());
            match self.remove_expired().await {
                Ok(0) => {}
                Ok(removed) => tracing::info!(removed, "expired jobs removed"),
                Err(error) => tracing::error!(%error, "expired jobs not removed"),
            }
        }
    }

    async fn sweep(&self, sweep: Sweep) -> StoreResult<()> {
        for job in self.store.sweep(sweep).await? {
            if job.state != State::Running {
                let (state, lost) = (job.state.word(), job.lost);
                tracing::warn!(job = %job.id, state, lost, "taken from its worker");
            }
            self.tell(&job).await;
        }
        Ok(())
    }

    async fn remove_expired(&self) -> StoreResult<usize> {
        let mut removed = 0;
        let Some(retention) = self.settings.retention else {
            return Ok(removed);
        };
        loop {
            let ids = self.store.ended_before(retention).await?;
            if ids.is_empty() {
                return Ok(removed);
            }
            for id in ids {
                self.remove(id, Reason::Expired).await?;
                removed += 1;
            }
        }
    }

    /// Removes the files that a crash left between their storing and that of their job, or between
    /// its removal and theirs.
    async fn remove_orphaned_files(&self) -> StoreResult<()> {
        let is_shared = self.settings.deployment == Deployment::Shared;
        for id in self.blobs.owners().await? {
            if is_shared && Timestamp::now().since(id.made()) < SUBMISSION_MS {
                continue;
            }
            if self.store.get(id).await?.is_none() {
                tracing::info!(job = %id, "files without a job removed");
                self.blobs.remove(&id.to_string()).await?;
            }
        }
        Ok(())
    }
}
