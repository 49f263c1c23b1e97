//! The store kept in order: jobs whose time is over, files without a job.

use std::collections::HashMap;
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::access::Reach;
use super::queue::Jobs;
use super::settings::Deployment;
use super::state::State;
use super::storage::{Reason, Sweep};
use super::store_error::{StoreError, StoreResult};
use super::timestamp::Timestamp;
use super::transition::Wish;

/// Searches for expired jobs per retention time: a job outlives it by a tenth at most,
const SEARCHES: u32 = 10;
/// and by no more than an hour. More than one search per second would keep the server busy.
const LONGEST_PAUSE: Duration = Duration::from_hours(1);
const SHORTEST_PAUSE: Duration = Duration::from_secs(1);
/// Files whose job is younger may belong to a submission under way in another process, whose clock
/// may be another.
const SUBMISSION: Duration = Duration::from_hours(24);
/// Jobs of files that are looked for at once.
const TOGETHER: usize = 1000;

impl Jobs {
    /// Puts the house in order after a start: scratch is emptied. What the only process left behind
    /// goes back to the queue, calls that nobody waits for any more are forgotten, and files
    /// without a job are removed.
    pub async fn recover(&self) -> StoreResult<()> {
        let scratch = &self.settings.scratch;
        if tokio::fs::try_exists(scratch).await? {
            let removed = tokio::fs::remove_dir_all(scratch).await;
            removed.map_err(StoreError::at(scratch))?;
        }
        let made = tokio::fs::create_dir_all(scratch).await;
        made.map_err(StoreError::at(scratch))?;
        if self.settings.deployment == Deployment::Embedded {
            self.sweep(Sweep::Abandoned).await?;
            for id in self.store.ephemeral().await? {
                self.wish(&Reach::All, id, Wish::Cancel).await?;
                self.remove(&Reach::All, id, Reason::Deleted).await?;
            }
            self.remove_orphaned_files(Duration::ZERO).await?;
        }
        Ok(())
    }

    /// Removes expired jobs and files without a job from time to time until told to stop.
    pub(super) async fn keep_until(&self, stop: &CancellationToken) {
        let retention = self.settings.retention.unwrap_or(Duration::MAX);
        let search = (retention / SEARCHES).clamp(SHORTEST_PAUSE, LONGEST_PAUSE);
        let mut interval = tokio::time::interval(search);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        // The only process has looked at its start.
        let is_only = self.settings.deployment == Deployment::Embedded;
        let mut looked = is_only.then(Instant::now);
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            // A process that is paused removes nothing.
            if self.is_draining() {
                continue;
            }
            if self.settings.retention.is_some() && looked.is_none_or(is_long_ago) {
                looked = Some(Instant::now());
                if let Err(error) = self.remove_orphaned_files(SUBMISSION).await {
                    tracing::warn!(%error, "files without a job not looked for");
                }
            }
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
        loop {
            let ids = self.store.ended_before(retention).await?;
            if ids.is_empty() {
                return Ok(removed);
            }
            for id in ids {
                self.remove(&Reach::All, id, Reason::Expired).await?;
                removed += 1;
            }
        }
    }

    /// Removes the files that a crash left between their storing and that of their job, between its
    /// cancellation or removal and theirs, if their job is older than this.
    async fn remove_orphaned_files(&self, age: Duration) -> StoreResult<()> {
        let mut owners = self.blobs.owners().await?;
        owners.retain(|id| age.as_millis() <= u128::from(Timestamp::now().since(id.made())));
        for owners in owners.chunks(TOGETHER) {
            let events = self.store.events(owners).await?;
            let events: HashMap<_, _> = events.into_iter().collect();
            for id in owners {
                let event = events.get(id);
                if event.is_none_or(|event| event.state == State::Cancelled) {
                    tracing::info!(job = %id, "files without a job removed");
                    self.blobs.remove(&id.to_string()).await?;
                }
            }
        }
        Ok(())
    }
}

/// Whether it is time to look for files without a job again.
fn is_long_ago(last: Instant) -> bool {
    SUBMISSION <= last.elapsed()
}
