//! From received files to a queued job.

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

/// For an owner to delete jobs.
const DELETION_TIME: Duration = Duration::from_mins(1);

/// A wish for a job, checked as far as that is possible without computing.
pub struct Submission {
    /// Whose the job is.
    pub owner: Owner,
    /// What to do.
    pub kind: Kind,
    /// Options of its kind, complete with defaults.
    pub options: serde_json::Value,
    /// The mesh, then the files it references, each with the place where it lies now. They are moved away.
    pub files: Vec<(InputFile, PathBuf)>,
    /// Names what is asked for; see [`Job::digest`].
    pub digest: String,
    /// How it is handled.
    pub handling: Handling,
    /// Whether the result of an equal job will do.
    pub reuse: bool,
    /// The trace that it is a part of; see [`Job::trace`].
    pub trace: Option<String>,
    /// The client's word that makes a repetition harmless.
    pub key: Option<String>,
    /// Whether it is of no use without the call that waits for it.
    pub ephemeral: bool,
}

/// An accepted submission.
#[derive(Debug)]
pub enum Submitted {
    /// A new job.
    New(Job),
    /// The job that the same key made before.
    Replay(Job),
}

/// Why a submission was not accepted.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// As many jobs wait as may wait. At the present pace there is a place after this time.
    #[error("the queue is full")]
    QueueFull(Duration),
    /// Its owner has as much as one may have. It may be less after this time.
    #[error("the owner has used up a quota")]
    OwnerQuota(OwnerQuota, Duration),
    /// The key belongs to another submission.
    #[error("the Idempotency-Key belongs to a different submission")]
    KeyReused,
    /// Files or record could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Jobs {
    /// Stores the files, then the record, and wakes the queue. When this returns, the job is not lost any more.
    pub async fn submit(&self, submission: Submission) -> Result<Submitted, SubmitError> {
        let id = JobId::fresh();
        let outcome = self.store_submission(id, submission).await;
        // The record may be there, and without its files its job would fail. If it is not, they are
        // files without a job.
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
        self.has_room()?;
        for (index, (_, path)) in submission.files.iter().enumerate() {
            self.blobs.put(&input_key(id, index), path).await?;
        }
        let key = submission.key.map(|key| IdempotencyKey {
            key,
            fingerprint: submission.handling.fingerprint(&submission.digest),
        });
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
        let capacity = self.capacity();
        match self.store.enqueue(&job, key.as_ref(), capacity).await? {
            Enqueued::New(job) => {
                meters::enqueued(&job);
                let (kind, trace) = (job.kind.word(), job.trace.as_deref());
                tracing::info!(job = %job.id, kind, trace, "accepted");
                self.look();
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
