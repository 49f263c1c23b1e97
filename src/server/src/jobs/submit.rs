//! Submission: from received files to a queued job.

use std::path::PathBuf;
use std::time::Duration;

use super::access::Owner;
use super::handling::Handling;
use super::job::{Job, JobId};
use super::keys::input_key;
use super::meters;
use super::queue::Jobs;
use super::quotas::OwnerQuota;
use super::storage::{Enqueued, IdempotencyKey};
use super::store_error::StoreError;
use super::timestamp::Timestamp;
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
