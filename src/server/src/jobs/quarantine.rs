//! Quarantine of files whose job is not in the database.
//!
//! A crash leaves a few such files: between storing files and their record, or between removing a record and its
//! files. A database restored from an older backup leaves many. So files are never deleted when they are found. They
//! stay in place, are listed, count against the quota, and are deleted only after they have been unknown for days, by
//! a clock that advances normally and without a gap between checks. A job that becomes known again takes its files
//! back.

use std::collections::{HashMap, HashSet};
use std::time::Duration;

use super::job::JobId;
use super::meters;
use super::queue::Jobs;
use super::state::State;
use super::store_error::StoreResult;
use super::timestamp::Timestamp;

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
        let is_old = |id: &JobId| age.as_millis() <= u128::from(Timestamp::now().since(id.made()));
        let old: Vec<JobId> = owners.iter().copied().filter(is_old).collect();
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
