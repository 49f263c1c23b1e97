//! Housekeeping of the store: removal of expired jobs and of files without a job, and requeuing of lost jobs.

use std::collections::{HashMap, HashSet};
use std::sync::atomic::Ordering;
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::access::Visibility;
use super::inspection::shared_identity;
use super::job::{JobId, State};
use super::meters;
use super::queue::Jobs;
use super::settings::Deployment;
use super::storage::{Reason, Sweep};
use super::store_error::{StoreError, StoreResult};
use super::timestamp::Timestamp;
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

// Quarantine of files whose job is not in the database.
//
// A crash leaves a few such files: between storing files and their record, or between removing a record and its
// files. A database restored from an older backup leaves many. So files are never deleted when they are found. They
// stay in place, are listed, count against the quota, and are deleted only after they have been unknown for days, by
// a clock that advances normally and without a gap between checks. A job that becomes known again takes its files
// back.

/// Number of jobs looked up at once. Larger batches hold more in memory, smaller ones take more transactions.
const TOGETHER: usize = 1000;
/// Threshold above which unknown files are no accident: more than this percentage of all jobs, and more than `MOST`
/// jobs. A crash leaves the files of the few jobs that were being stored or removed, a wrong or restored database
/// those of many. Higher thresholds may delete files that a database still needs.
const MOST_PERCENT: usize = 1;
const MOST: usize = 20;

impl Jobs {
    /// Quarantines files without a job if the job's id is older than `age`, and deletes those that have been in
    /// quarantine long enough. Deletes nothing while too many are unknown.
    pub(super) async fn sweep_unknown_files(&self, age: Duration) -> StoreResult<()> {
        // Find the jobs that have files but no record, and the entries that are known again.
        let owners = self.blobs.owners().await?;
        let unknown = self.unknown(&owners, age).await?;
        let quarantined = self.store.quarantined().await?;
        let known: Vec<JobId> = quarantined.iter().map(|files| files.job).collect();
        let known: Vec<JobId> = (known.into_iter())
            .filter(|job| !unknown.contains(job))
            .collect();
        // Release files whose job is known again, and quarantine the rest.
        self.store.release(&known).await?;
        for jobs in unknown.iter().copied().collect::<Vec<_>>().chunks(TOGETHER) {
            let mut found = Vec::new();
            for &job in jobs {
                let files = self.blobs.list(&job.to_string()).await?;
                found.push((job, files.iter().map(|(_, bytes)| bytes).sum()));
            }
            self.store.quarantine(&found).await?;
        }
        for job in &unknown {
            if !quarantined.iter().any(|files| files.job == *job) {
                tracing::warn!(%job, "files without a job are in quarantine");
            }
        }
        // Delete nothing if the number suggests a wrong or restored database.
        let is_stopped = is_too_many(unknown.len(), owners.len());
        meters::quarantine_stopped(is_stopped);
        if is_stopped {
            let (unknown, of) = (unknown.len(), owners.len());
            tracing::error!(
                unknown,
                of,
                "too many files without a job: none is deleted. Restore the database that knows \
                 them, or delete them with `unwrapd check --purge`"
            );
            return Ok(());
        }
        if self.clock_is_steady().await? {
            self.delete_quarantined().await?;
        }
        Ok(())
    }

    /// Returns the jobs at least this old that have files but no record. Removes files of cancelled jobs, which need
    /// none.
    async fn unknown(&self, owners: &[JobId], age: Duration) -> StoreResult<HashSet<JobId>> {
        let old: Vec<JobId> = (owners.iter().copied())
            .filter(|id| age.as_millis() <= u128::from(Timestamp::now().since(id.made())))
            .collect();
        let mut unknown = HashSet::new();
        for owners in old.chunks(TOGETHER) {
            let events: HashMap<_, _> = self.store.events(owners).await?.into_iter().collect();
            for &id in owners {
                match events.get(&id) {
                    None => drop(unknown.insert(id)),
                    Some(event) if event.state == State::Cancelled => {
                        self.blobs.remove(&id.to_string()).await?;
                    }
                    Some(_) => {}
                }
            }
        }
        Ok(unknown)
    }

    /// Deletes files that have been in quarantine long enough.
    async fn delete_quarantined(&self) -> StoreResult<()> {
        for files in self.store.quarantined().await? {
            let is_due = self.settings.quarantine <= files.age;
            if is_due && self.store.events(&[files.job]).await?.is_empty() {
                tracing::warn!(job = %files.job, bytes = files.bytes, "files without a job deleted");
                self.blobs.remove(&files.job.to_string()).await?;
                self.store.release(&[files.job]).await?;
            }
        }
        Ok(())
    }
}

/// Returns whether too many of all files are unknown for an accident.
fn is_too_many(unknown: usize, all: usize) -> bool {
    MOST < unknown && MOST_PERCENT * all < 100 * unknown
}

// Sweeping: jobs of silent workers go back to the queue.

/// Sweeps per lease. A job is taken from a silent worker after about 4/3 of a lease at most; more sweeps shorten the
/// delay but query the store more often.
const SWEEPS: u32 = 3;

impl Jobs {
    /// Sweeps periodically until stopped. Takes no job before the store has answered without delay for the time of a
    /// lease: workers that could not reach the store are not silent, and hand their jobs back themselves.
    pub(super) async fn sweep_until(&self, stop: &CancellationToken) {
        let lease = self.settings.rules.lease;
        let pause = lease / SWEEPS;
        let mut interval = tokio::time::interval(pause);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut answers_since = Instant::now();
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            // Ask the store a short question, and count the time since its last slow or missing answer.
            let asked = Instant::now();
            let mut answer = self.store.check().await;
            if asked.elapsed() > pause {
                answers_since = Instant::now();
            }
            // Sweep once workers have had the time of a lease to reach the store again.
            if answer.is_ok() && answers_since.elapsed() >= lease {
                answer = self.sweep(Sweep::Overdue).await;
            }
            if let Err(error) = answer {
                meters::store_failed();
                tracing::error!(%error, "jobs of silent workers not looked for");
                answers_since = Instant::now();
            }
        }
    }

    /// Takes jobs from their workers and notifies watchers.
    pub(super) async fn sweep(&self, sweep: Sweep) -> StoreResult<()> {
        for job in self.store.sweep(sweep).await? {
            if job.state != State::Running {
                meters::taken();
                let (state, interrupted) = (job.state.word(), job.interrupted);
                tracing::warn!(job = %job.id, state, interrupted, "taken from its worker");
            }
            self.tell(&job).await;
        }
        Ok(())
    }
}
