//! The storage interfaces: for job records, job files and notices.

use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::str::FromStr;
use std::time::Duration;

use futures_util::future::BoxFuture;
use futures_util::stream::BoxStream;
use serde::Deserialize;
use serde_json::json;
use uuid::Uuid;

use super::access::{Owner, Visibility};
use super::handling::{Metadata, Webhook};
use super::job::{Event, Job, JobId, ProgressReport, State, Token, WorkerId};
use super::store_error::StoreResult;
use super::timestamp::Timestamp;
use super::transition::{Refusal, Transition};
use unwrapd_api::Kind;

/// Key by which a client marks repeated submissions as one. Each owner has keys of its own.
#[derive(Clone, Debug)]
pub struct IdempotencyKey {
    /// Key chosen by the client.
    pub key: String,
    /// Hash of the submission, which must be the same whenever the key is used.
    pub fingerprint: String,
}

/// Outcome of a submission.
#[derive(Debug)]
pub enum Enqueued {
    /// It is a new job, as recorded.
    New(Box<Job>),
    /// It was submitted before under the same key.
    Replay(Box<Job>),
    /// The key was used for a different submission.
    KeyReused,
    /// The queue is full.
    Full,
    /// Its owner would exceed a quota or has used it up.
    OwnerOverQuota(OwnerQuota),
    /// The files of all jobs together would exceed the quota.
    OverQuota,
}

/// Filter of the jobs that a worker takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Maximum bytes of a job's files.
    pub largest: Option<u64>,
    /// Maximum number of running jobs of its owner, in all processes, including the new one.
    pub of_owner: Option<u32>,
    /// Set if the worker computes other jobs. A busy worker gets no suspected job, and when a suspected job has
    /// waited for minutes, it gets no job at all, so that it becomes free.
    pub is_busy: bool,
}

/// Overview of all jobs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Queue {
    /// Number of jobs in each state.
    pub counts: Vec<(State, u64)>,
    /// Waiting time of the oldest queued job.
    pub oldest_wait: Duration,
}

/// Numbers of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Census {
    /// Number of jobs.
    pub jobs: u64,
    /// Number of jobs that have files.
    pub with_files: u64,
}

/// Outcome of an event.
#[derive(Clone, Debug)]
pub enum Changed {
    /// The record changed to this.
    Yes(Box<Job>),
    /// The record was not changed, for this reason.
    No(Box<Job>, Refusal),
    /// There is no such record.
    Missing,
}

/// Heartbeat of a worker for one job: job, token and progress.
pub type Heartbeat = (JobId, Token, ProgressReport);

/// Running jobs to take from their workers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    /// Jobs whose leases have expired.
    Overdue,
    /// All jobs: no former worker can be alive.
    Abandoned,
}

/// Reason for removing a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A client deleted it.
    Deleted,
    /// It expired, which is remembered.
    Expired,
}

/// Files in quarantine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quarantined {
    /// Job whose folder they are in.
    pub job: JobId,
    /// Size in bytes.
    pub bytes: u64,
    /// Time for which they have been unknown.
    pub age: Duration,
}

/// Store of job records. Every call is one transaction, durable when it returns. Times are those of the store's own
/// clock. Only [`after`](super::after) decides how a record changes. Jobs outside the visibility of a call are reported as
/// missing.
pub trait JobStore: Send + Sync {
    /// Records a job that is queued or has ended, unless it would exceed the capacity or its key has been used. Sets
    /// its times.
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>>;

    /// Returns the record of a job.
    fn get<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<Option<Job>>>;

    /// Returns a page of the list.
    fn list<'a>(
        &'a self,
        visibility: &'a Visibility,
        listing: &'a Listing,
    ) -> BoxFuture<'a, StoreResult<Vec<Job>>>;

    /// Returns the current states of those of these jobs that exist, in any order.
    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>>;

    /// Returns the latest succeeded jobs with the digest and the owner of this one.
    fn equal<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<Vec<Job>>>;

    /// Assigns a queued job that may start to a worker. Takes the owner with the fewest running jobs, and among those
    /// the one whose last start was longest ago. Of that owner's jobs, takes the oldest of the highest priority.
    fn claim(&self, worker: WorkerId, share: Share) -> BoxFuture<'_, StoreResult<Option<Job>>>;

    /// Pauses or resumes claiming, for all processes.
    fn set_paused(&self, paused: bool) -> BoxFuture<'_, StoreResult<()>>;

    /// Returns whether claiming is paused.
    fn is_paused(&self) -> BoxFuture<'_, StoreResult<bool>>;

    /// Returns the number of jobs that were computed and ended within this time before now.
    fn ended_within(&self, time: Duration) -> BoxFuture<'_, StoreResult<u64>>;

    /// Waits for a hint that a job can be claimed. Hints may be lost, and some stores give none.
    fn hint(&self) -> BoxFuture<'_, ()>;

    /// Applies an event to a record.
    fn change<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        transition: &'a Transition,
    ) -> BoxFuture<'a, StoreResult<Changed>>;

    /// Records the heartbeats of one worker. Returns the outcome for each, in order.
    fn heartbeat<'a>(
        &'a self,
        heartbeats: &'a [Heartbeat],
    ) -> BoxFuture<'a, StoreResult<Vec<Changed>>>;

    /// Takes running jobs from their workers. Returns the records that changed.
    fn sweep(&self, sweep: Sweep) -> BoxFuture<'_, StoreResult<Vec<Job>>>;

    /// Removes a record in a final state and its idempotency key. Returns `false` if there is none.
    fn delete<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        reason: Reason,
    ) -> BoxFuture<'a, StoreResult<bool>>;

    /// Returns whether there was a job until it expired. This is known for a year.
    fn has_expired<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<bool>>;

    /// Returns some jobs that ended longer ago than `kept`. A job that belongs to a request is included a few minutes
    /// after its end.
    fn ended_before(&self, kept: Duration) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Deletes the idempotency keys of submissions made more than a day ago.
    fn forget_keys(&self) -> BoxFuture<'_, StoreResult<()>>;

    /// Returns the jobs that belong to synchronous requests.
    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Returns the number of jobs in each state, and the wait of the oldest queued job.
    fn queue(&self) -> BoxFuture<'_, StoreResult<Queue>>;

    /// Returns the bytes of the files of all jobs, including quarantined files.
    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>>;

    /// Returns the time by the clock of the store.
    fn now(&self) -> BoxFuture<'_, StoreResult<Timestamp>>;

    /// Returns the id of this store; `None` for a new one and for one of version 0.1.0.
    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>>;

    /// Sets the id of the store if it has none. Returns its id.
    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<StoreId>>;

    /// Returns the numbers of records.
    fn census(&self) -> BoxFuture<'_, StoreResult<Census>>;

    /// Records files without a job, with their sizes in bytes. Restarts the time of files that were last recorded
    /// more than three days ago, or at a time that the clock has not reached.
    fn quarantine<'a>(&'a self, files: &'a [(JobId, u64)]) -> BoxFuture<'a, StoreResult<()>>;

    /// Returns all quarantined files, oldest first.
    fn quarantined(&self) -> BoxFuture<'_, StoreResult<Vec<Quarantined>>>;

    /// Removes entries from quarantine because their files have a job again or are gone.
    fn release<'a>(&'a self, jobs: &'a [JobId]) -> BoxFuture<'a, StoreResult<()>>;

    /// Excludes the result of this job from being copied for equal jobs.
    fn spoil(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>>;

    /// Writes a probe to check that records can be written.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;
}

// Filter and order of job lists.

/// Filter, order and page of a job list. Absent filters match everything.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// State to match.
    pub state: Option<State>,
    /// Kind to match.
    pub kind: Option<Kind>,
    /// Owner to match.
    pub owner: Option<Owner>,
    /// Metadata members that must all match.
    pub metadata: Metadata,
    /// Words that must all be found, as [`Job::is_found_by`] says.
    pub words: Vec<String>,
    /// Earliest time of acceptance.
    pub since: Option<Timestamp>,
    /// Time before which jobs were accepted.
    pub until: Option<Timestamp>,
    /// Order of the list.
    pub order: Order,
    /// Job after which the page starts.
    pub after: Option<JobId>,
    /// Maximum number of jobs.
    pub limit: u32,
}

/// Order of jobs: the one of two jobs that comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// The later one.
    #[default]
    NewestFirst,
    /// The earlier one.
    OldestFirst,
}

// Storage quotas, in total and per owner.

/// Limits on what may be stored.
#[derive(Clone, Copy, Debug)]
pub struct Capacity {
    /// Maximum number of queued jobs.
    pub depth: u32,
    /// Maximum bytes of all jobs' files, including those of the job to be accepted.
    pub bytes: Option<u64>,
    /// Quotas of each owner.
    pub of_owner: OwnerQuotas,
}

/// Quotas of one owner.
#[derive(Clone, Copy, Debug, Default)]
pub struct OwnerQuotas {
    /// Maximum number of queued and running jobs.
    pub jobs: Option<u32>,
    /// Maximum bytes of the files of all their jobs.
    pub bytes: Option<u64>,
    /// Maximum processor time per day in UTC.
    pub cpu_of_day: Option<Duration>,
}

/// Kind of quota of an owner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnerQuota {
    /// [`OwnerQuotas::jobs`].
    Jobs,
    /// [`OwnerQuotas::bytes`].
    Bytes,
    /// [`OwnerQuotas::cpu_of_day`].
    Cpu,
}

// The storage interface for job files.

/// Content of a file as a stream of blocks.
pub type Content = BoxStream<'static, StoreResult<Vec<u8>>>;

/// Files of jobs, under keys such as `ID/input/0`. A file exists completely or not at all, and is never modified.
pub trait Blobs: Send + Sync {
    /// Stores a local file under a key, durably. The local file may be moved away.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Copies the content of one key to another, as durably as [`Blobs::put`].
    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Copies a file to a local path.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Reads this byte range of a file.
    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>>;

    /// Returns the ids of the jobs that have files.
    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Returns the keys in this folder, with file sizes in bytes.
    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>>;

    /// Returns the id of the store that the files belong to; `None` for new storage and for that of version 0.1.0.
    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>>;

    /// Records the id of the store that the files belong to.
    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>>;

    /// Returns the number of free bytes; `None` if the storage does not count them.
    fn free_bytes(&self) -> StoreResult<Option<u64>>;

    /// Checks that files can be stored now, by writing a probe from time to time.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;

    /// Removes all files in this folder. Succeeds if there are none.
    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>>;
}

// The id that a database and its files share.

/// Id of a store: a database together with its files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoreId(Uuid);

impl StoreId {
    /// Creates an id that no other store has.
    pub fn fresh() -> Self {
        Self(Uuid::now_v7())
    }
}

impl fmt::Display for StoreId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for StoreId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.trim().parse().map(Self)
    }
}

// Notices of ended jobs, waiting for delivery.

/// A notice that a job has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Id of the notice, the same in every delivery.
    pub id: String,
    /// Owner of the job.
    pub owner: Owner,
    /// Destination.
    pub webhook: Webhook,
    /// Content: a JSON object.
    pub body: String,
    /// Number of delivery attempts, including the current one.
    pub attempt: u32,
}

impl Notice {
    /// Returns the notice of a job that has just ended; `None` if it has no webhook or has not ended.
    pub fn of_end(job: &Job) -> Option<Self> {
        let end = job.finished.filter(|_| job.state.is_final())?;
        let body = json!({
            "type": format!("job.{}", job.state.word()),
            "timestamp": end,
            "data": {
                "id": job.id,
                "kind": job.kind,
                "state": job.state,
                "filename": job.input.first().map(|file| &file.name),
                "metadata": job.metadata,
                "certified": job.verdict.quality.certified,
                "within_bound": job.verdict.within_bound,
                "accepted": job.accepted(),
                "error": job.failure,
                "created_at": job.created,
                "started_at": job.started,
                "finished_at": end,
            },
        });
        Some(Self {
            id: format!("msg_{}", Uuid::now_v7().simple()),
            owner: job.owner.clone(),
            webhook: job.webhook.clone()?,
            body: body.to_string(),
            attempt: 0,
        })
    }
}

/// Queue of notices to be delivered. They are recorded in the transaction that ends the job, and stay until they are
/// settled.
pub trait Outbox: Send + Sync {
    /// Takes at most `most` notices that are due. Nobody else gets them during `lease`; afterwards they are due
    /// again.
    fn take(&self, most: u32, lease: Duration) -> BoxFuture<'_, StoreResult<Vec<Notice>>>;

    /// Deletes a notice that was delivered or given up.
    fn settle<'a>(&'a self, id: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Makes a notice due again after a pause.
    fn defer<'a>(&'a self, id: &'a str, pause: Duration) -> BoxFuture<'a, StoreResult<()>>;
}
