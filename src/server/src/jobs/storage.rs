//! The storage interface for job records.

use std::time::Duration;

use futures_util::future::BoxFuture;

use super::access::Visibility;
use super::job::{Job, JobId};
use super::lease::{Token, WorkerId};
use super::listing::Listing;
use super::progress::{Event, ProgressReport};
use super::quotas::{Capacity, OwnerQuota};
use super::state::State;
use super::store_error::StoreResult;
use super::store_id::StoreId;
use super::timestamp::Timestamp;
use super::transition::{Refusal, Transition};

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
