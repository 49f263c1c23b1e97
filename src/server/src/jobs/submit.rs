//! Submission: from received files to a queued job, with the room that it needs; and retrying failed jobs.

use std::path::PathBuf;
use std::time::Duration;

use super::access::{Owner, Visibility};
use super::files::{free_bytes, input_key};
use super::handling::Handling;
use super::job::{Job, JobId, State};
use super::meters;
use super::queue::Jobs;
use super::storage::{
    Capacity, Changed, Enqueued, IdempotencyKey, JobStore, Listing, Order, OwnerQuota,
};
use super::store_error::{StoreError, StoreResult};
use super::timestamp::Timestamp;
use super::transition::{Command, Transition};
use unwrapd_api::{InputFile, Kind};

/// Retry delay suggested when an owner has to delete jobs first. Nothing frees the space before the owner acts, so
/// there is no estimate.
const DELETION_TIME: Duration = Duration::from_mins(1);

/// A requested job, checked as far as possible without computing.
pub struct Submission {
    /// Owner of the job.
    pub owner: Owner,
    /// Kind of the computation.
    pub kind: Kind,
    /// Options of its kind, complete with defaults.
    pub options: serde_json::Value,
    /// Input files with their current paths: the mesh, then the files it references. They may be moved away.
    pub files: Vec<(InputFile, PathBuf)>,
    /// Digest of the request; see [`Job::digest`].
    pub digest: String,
    /// Handling of the job.
    pub handling: Handling,
    /// Set if the result of an equal job may be reused.
    pub reuse: bool,
    /// Trace that it is part of; see [`Job::trace`].
    pub trace: Option<String>,
    /// Idempotency key.
    pub key: Option<String>,
    /// Set if it is of no use without the request that waits for it.
    pub ephemeral: bool,
}

/// An accepted submission.
#[derive(Debug)]
pub enum Submitted {
    /// A new job.
    New(Job),
    /// The job created before with the same key.
    Replay(Job),
}

/// Reason for rejecting a submission.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// The queue is full. At its current throughput there will be a place after this time.
    #[error("the queue is full")]
    QueueFull(Duration),
    /// Its owner has used up a quota. The use may be lower after this time.
    #[error("the owner has used up a quota")]
    OwnerQuota(OwnerQuota, Duration),
    /// The key belongs to a different submission.
    #[error("the Idempotency-Key belongs to a different submission")]
    KeyReused,
    /// Files or record could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Jobs {
    /// Stores the files, then the record, and wakes the queue. Once this returns, the job is durable.
    pub async fn submit(&self, submission: Submission) -> Result<Submitted, SubmitError> {
        let id = JobId::fresh();
        let outcome = self.store_submission(id, submission).await;
        // Keep the files if the record may exist: without them its job would fail. If it does not exist, they are
        // quarantined like all files without a job.
        let may_be_recorded = matches!(
            outcome,
            Ok(Submitted::New(_)) | Err(SubmitError::Store(StoreError::Unanswered(_)))
        );
        if !may_be_recorded && let Err(error) = self.blobs.remove(&id.to_string()).await {
            tracing::warn!(job = %id, %error, "files of a refused job not removed");
        }
        outcome
    }

    async fn store_submission(
        &self,
        id: JobId,
        submission: Submission,
    ) -> Result<Submitted, SubmitError> {
        // Store the files first: a record must never refer to missing ones.
        self.has_room()?;
        for (index, (_, path)) in submission.files.iter().enumerate() {
            self.blobs.put(&input_key(id, index), path).await?;
        }
        let key = submission.key.map(|key| IdempotencyKey {
            key,
            fingerprint: submission.handling.fingerprint(&submission.digest),
        });
        // Build the record, and complete it from an equal job if there is one.
        let mut job = Job {
            owner: submission.owner,
            input: submission.files.into_iter().map(|(file, _)| file).collect(),
            digest: submission.digest,
            priority: submission.handling.priority,
            metadata: submission.handling.metadata,
            accept: submission.handling.accept,
            webhook: submission.handling.webhook,
            trace: submission.trace,
            ephemeral: submission.ephemeral,
            ..Job::queued(id, submission.kind, submission.options)
        };
        if submission.reuse {
            self.reuse(&mut job).await;
        }
        // Record the job, or explain the rejection.
        let capacity = self.capacity();
        match self.store.enqueue(&job, key.as_ref(), capacity).await? {
            Enqueued::New(job) => {
                meters::enqueued(&job);
                let (kind, trace) = (job.kind.word(), job.trace.as_deref());
                tracing::info!(job = %job.id, kind, trace, "accepted");
                self.wake_lanes();
                Ok(Submitted::New(*job))
            }
            Enqueued::Replay(earlier) => Ok(Submitted::Replay(*earlier)),
            Enqueued::KeyReused => Err(SubmitError::KeyReused),
            Enqueued::Full => Err(SubmitError::QueueFull(self.next_place().await)),
            Enqueued::OwnerOverQuota(quota) => {
                let after = match quota {
                    OwnerQuota::Jobs => self.next_place().await,
                    OwnerQuota::Bytes => DELETION_TIME,
                    OwnerQuota::Cpu => Timestamp::now().until_next_day(),
                };
                Err(SubmitError::OwnerQuota(quota, after))
            }
            Enqueued::OverQuota => {
                let detail = "the files of all jobs would take more than they may".to_owned();
                Err(StoreError::Full(detail).into())
            }
        }
    }
}

// Storage use, and admission of new jobs.

/// Period over which the throughput of the queue is measured. Over longer periods the estimate lags behind changes;
/// in shorter ones too few long jobs end.
const THROUGHPUT_PERIOD: Duration = Duration::from_mins(5);
/// Estimated wait for a place in the queue when no job has ended lately. Without a throughput there is nothing to
/// derive it from.
const UNKNOWN_WAIT: Duration = Duration::from_mins(1);

/// Timeout for file storage to respond. `/readyz` and `/metrics` take this long at most if it hangs.
const BLOBS_PATIENCE: Duration = Duration::from_secs(5);

/// Storage in use and available.
#[derive(Clone, Copy, Debug)]
pub struct Usage {
    /// Bytes of the files of all jobs, including quarantined files.
    pub stored: u64,
    /// Number of jobs without a record whose files are quarantined.
    pub quarantined: usize,
    /// Bytes of quarantined files.
    pub quarantined_bytes: u64,
    /// Maximum for `stored`; `None` if there is no quota.
    pub quota: Option<u64>,
    /// Free bytes in file storage; `None` if it does not count them.
    pub free: Option<u64>,
    /// Free bytes on the disk of uploads and attempts.
    pub scratch_free: u64,
}

impl Jobs {
    /// Returns the limits on what may be stored.
    pub(super) fn capacity(&self) -> Capacity {
        Capacity {
            depth: self.settings.queue_depth,
            bytes: self.settings.quota,
            of_owner: self.settings.of_owner,
        }
    }

    /// Estimates when a place in the queue will be free, from the throughput of the last minutes.
    pub(super) async fn next_place(&self) -> Duration {
        match self.store.ended_within(THROUGHPUT_PERIOD).await {
            Ok(ended @ 1..) => {
                (THROUGHPUT_PERIOD / ended.min(1000) as u32).max(Duration::from_secs(1))
            }
            _ => UNKNOWN_WAIT,
        }
    }

    /// Returns what is stored and what is free.
    pub async fn usage(&self) -> StoreResult<Usage> {
        let quarantined = self.store.quarantined().await?;
        Ok(Usage {
            stored: self.store.stored_bytes().await?,
            quarantined: quarantined.len(),
            quarantined_bytes: quarantined.iter().map(|files| files.bytes).sum(),
            quota: self.settings.quota,
            free: self.blobs.free_bytes()?,
            scratch_free: free_bytes(&self.settings.scratch)?,
        })
    }

    /// Checks that the disks have room for what a job needs. Refusing early leaves room for running jobs to end.
    pub fn has_room(&self) -> StoreResult<()> {
        let scratch = free_bytes(&self.settings.scratch)?;
        let free = self.blobs.free_bytes()?.unwrap_or(scratch).min(scratch);
        if free < self.settings.min_free {
            let (free, least) = (free >> 20, self.settings.min_free >> 20);
            let detail = format!("{free} MiB are free, and {least} MiB must be");
            return Err(StoreError::Full(detail));
        }
        Ok(())
    }

    /// Checks that the files belong to this store and that more can be stored.
    pub async fn check_blobs(&self) -> StoreResult<()> {
        // Compare the identity first: a probe would also succeed on an empty mount point.
        let check = async {
            if let Some(own) = self.identity.get() {
                match self.blobs.identity().await? {
                    Some(found) if found == *own => {}
                    Some(found) => {
                        let detail = format!("the files are of store {found}, not of {own}");
                        return Err(StoreError::Unavailable(detail));
                    }
                    None => {
                        let detail = "the place for files is empty: is it mounted?".to_owned();
                        return Err(StoreError::Unavailable(detail));
                    }
                }
            }
            self.blobs.check().await
        };
        let answer = tokio::time::timeout(BLOBS_PATIENCE, check).await;
        answer.unwrap_or_else(|_| {
            let detail = "the place for files does not answer".to_owned();
            Err(StoreError::Unavailable(detail))
        })
    }

    /// Checks that a job would be accepted now: records and files can be written, disks have room, and the quota is
    /// not used up.
    pub async fn check(&self) -> StoreResult<()> {
        self.store.check().await?;
        self.has_room()?;
        self.check_blobs().await?;
        match self.settings.quota {
            Some(quota) if quota <= self.store.stored_bytes().await? => {
                let detail = format!("the jobs use all of their {} MiB", quota >> 20);
                Err(StoreError::Full(detail))
            }
            _ => Ok(()),
        }
    }
}

// Retrying many failed jobs at once.

/// Jobs per page. Larger pages hold more records in memory, smaller ones need more queries.
const PAGE: u32 = 200;
/// Maximum number of jobs retried by one request, which bounds its duration; clients continue with `next`.
const MOST: usize = 1000;

/// Failed jobs that were requeued.
#[derive(Debug, Default)]
pub struct Retried {
    /// The jobs, oldest first.
    pub jobs: Vec<Job>,
    /// Job after which there may be more; `None` if all were retried.
    pub next: Option<JobId>,
}

/// Retries up to 1000 failed jobs that match a listing, oldest first. If a code is given, retries only jobs that
/// failed with it.
pub async fn retry_failed(
    store: &dyn JobStore,
    visibility: &Visibility,
    listing: Listing,
    code: Option<&str>,
) -> StoreResult<Retried> {
    // Select failed jobs, oldest first.
    let mut listing = Listing {
        state: Some(State::Failed),
        order: Order::OldestFirst,
        limit: PAGE,
        ..listing
    };
    let mut retried = Retried::default();
    loop {
        let page = store.list(visibility, &listing).await?;
        for job in &page {
            // The code is no filter of the store, so it is compared here.
            let failure = job.failure.as_ref().map(|failure| failure.code.as_str());
            if code.is_some() && failure != code {
                continue;
            }
            // Requeue the job. A job that has not failed any more is left alone.
            let again = Transition::Commanded(Command::Retry);
            if let Changed::Yes(job) = store.change(visibility, job.id, &again).await? {
                retried.jobs.push(*job);
            }
            if MOST <= retried.jobs.len() {
                retried.next = Some(job.id);
                return Ok(retried);
            }
        }
        match page.last() {
            Some(last) => listing.after = Some(last.id),
            None => return Ok(retried),
        }
    }
}

impl Jobs {
    /// Retries failed jobs and notifies watchers; see [`retry_failed`].
    pub async fn retry_failed(
        &self,
        visibility: &Visibility,
        listing: Listing,
        code: Option<&str>,
    ) -> StoreResult<Retried> {
        let retried = retry_failed(self.store.as_ref(), visibility, listing, code).await?;
        for job in &retried.jobs {
            self.tell(job).await;
        }
        Ok(retried)
    }
}
