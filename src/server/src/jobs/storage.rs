//! What the queue needs from a place for records.

use std::time::Duration;

use futures_util::future::BoxFuture;

use super::access::Reach;
use super::job::{Job, JobId};
use super::lease::{Token, WorkerId};
use super::listing::Listing;
use super::progress::{Event, Saying};
use super::quotas::{Capacity, OwnerQuota};
use super::state::State;
use super::store_error::StoreResult;
use super::store_id::StoreId;
use super::timestamp::Timestamp;
use super::transition::{Happening, Refusal};

/// A client's promise that two submissions with the same key are one. Each owner has keys of their
/// own.
#[derive(Clone, Debug)]
pub struct IdempotencyKey {
    /// The client's word.
    pub key: String,
    /// Hash of what was submitted: files, kind and options.
    pub fingerprint: String,
}

/// What became of a submission.
#[derive(Debug)]
pub enum Enqueued {
    /// It is a new job, as recorded.
    New(Box<Job>),
    /// It was made before, under the same key.
    Replay(Box<Job>),
    /// The key was used for something else.
    KeyReused,
    /// As many jobs wait as may wait.
    Full,
    /// Its owner would have more than one may have, or has used it up.
    OwnerOverQuota(OwnerQuota),
    /// The files of all jobs together would take more than they may.
    OverQuota,
}

/// Which jobs a worker takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Only those whose files have at most so many bytes.
    pub largest: Option<u64>,
    /// Only those of owners of whom fewer than so many run, in all processes.
    pub of_owner: Option<u32>,
    /// Whether the worker computes other jobs. Those that may kill their workers are not for it, and
    /// when one of them has waited for minutes, it gets none at all: it has to become free.
    pub is_busy: bool,
}

/// All jobs at a glance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Queue {
    /// How many there are in each state.
    pub counts: Vec<(State, u64)>,
    /// For how long the oldest of those that wait has been there.
    pub oldest_wait: Duration,
}

/// What records there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Census {
    /// Jobs.
    pub jobs: u64,
    /// Those that have files.
    pub with_files: u64,
}

/// What became of a record.
#[derive(Clone, Debug)]
pub enum Changed {
    /// It changed to this.
    Yes(Box<Job>),
    /// It is still this.
    No(Box<Job>, Refusal),
    /// There is none.
    Missing,
}

/// A worker's sign of life for one job: which, as which holder, and how far it is.
pub type Beat = (JobId, Token, Saying);

/// Which running jobs to take from their workers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    /// Those whose workers have been silent for too long.
    Overdue,
    /// All: no worker of an earlier time can be alive.
    Abandoned,
}

/// Why a record is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A client wished so.
    Deleted,
    /// Its time was over. That is remembered.
    Expired,
}

/// Files in quarantine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quarantined {
    /// The job whose folder they are in.
    pub job: JobId,
    /// Their size.
    pub bytes: u64,
    /// For how long they have been unknown.
    pub held: Duration,
}

/// Records of jobs. Every call is one transaction, durable when it returns. Times are those of the
/// store's own clock, and what becomes of a record is decided by [`after`](super::after) alone. What
/// lies beyond the reach that a call has is missing for it.
pub trait JobStore: Send + Sync {
    /// Stores a job that is queued or has ended, unless that would exceed the capacity or its key has been used. Its
    /// times are set.
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>>;

    /// The record of a job.
    fn get<'a>(&'a self, reach: &'a Reach, id: JobId) -> BoxFuture<'a, StoreResult<Option<Job>>>;

    /// A page of the list.
    fn list<'a>(
        &'a self,
        reach: &'a Reach,
        listing: &'a Listing,
    ) -> BoxFuture<'a, StoreResult<Vec<Job>>>;

    /// The present states of those of these jobs that exist, in any order.
    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>>;

    /// The latest jobs with the digest and the owner of this one that succeeded and are kept.
    fn equal<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<Vec<Job>>>;

    /// Gives a queued job that may be started to a worker. It belongs to the owner who has the fewest
    /// running, and among those to the one whose last start was longest ago. Of this owner's jobs it
    /// is one of the highest priority, and of those the oldest.
    fn claim(&self, worker: WorkerId, share: Share) -> BoxFuture<'_, StoreResult<Option<Job>>>;

    /// Has no job claimed by anybody from now on, or again.
    fn set_paused(&self, paused: bool) -> BoxFuture<'_, StoreResult<()>>;

    /// Whether no job is claimed.
    fn is_paused(&self) -> BoxFuture<'_, StoreResult<bool>>;

    /// How many jobs were computed and ended within this time before now.
    fn ended_within(&self, time: Duration) -> BoxFuture<'_, StoreResult<u64>>;

    /// Waits for a hint that a job can be claimed. A hint may be lost, and some stores give none.
    fn hint(&self) -> BoxFuture<'_, ()>;

    /// Changes a record as what happens demands.
    fn change<'a>(
        &'a self,
        reach: &'a Reach,
        id: JobId,
        happening: &'a Happening,
    ) -> BoxFuture<'a, StoreResult<Changed>>;

    /// Records signs of life of one worker; what became of each record, in their order.
    fn beat<'a>(&'a self, beats: &'a [Beat]) -> BoxFuture<'a, StoreResult<Vec<Changed>>>;

    /// Takes running jobs from their workers. Returns those that changed.
    fn sweep(&self, sweep: Sweep) -> BoxFuture<'_, StoreResult<Vec<Job>>>;

    /// Removes a record in a final state and its idempotency key; false if there is none.
    fn delete<'a>(
        &'a self,
        reach: &'a Reach,
        id: JobId,
        reason: Reason,
    ) -> BoxFuture<'a, StoreResult<bool>>;

    /// Whether there was a job until its time was over. This is known for a year.
    fn has_expired<'a>(&'a self, reach: &'a Reach, id: JobId) -> BoxFuture<'a, StoreResult<bool>>;

    /// Some jobs that ended longer ago than this. A job that belongs to a call is of no use a few
    /// minutes after its end.
    fn ended_before(&self, kept: Duration) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Forgets the idempotency keys of submissions that were made more than a day ago.
    fn forget_keys(&self) -> BoxFuture<'_, StoreResult<()>>;

    /// The jobs that belong to calls.
    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// How many jobs there are in each state, and how long the oldest of those that wait does so.
    fn queue(&self) -> BoxFuture<'_, StoreResult<Queue>>;

    /// Bytes of the files of all jobs, and of those in quarantine.
    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>>;

    /// What time it is by the clock of the store.
    fn now(&self) -> BoxFuture<'_, StoreResult<Timestamp>>;

    /// Which store this is; `None` in a new one, and in one of version 0.1.0.
    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>>;

    /// Gives the store this identity if it has none. Returns the one that it has then.
    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<StoreId>>;

    /// What records there are.
    fn census(&self) -> BoxFuture<'_, StoreResult<Census>>;

    /// Notes files without a job, with their sizes. The time of those that were not looked at for
    /// three days, or that the clock has left behind, begins anew.
    fn quarantine<'a>(&'a self, files: &'a [(JobId, u64)]) -> BoxFuture<'a, StoreResult<()>>;

    /// All files that were noted, the oldest first.
    fn quarantined(&self) -> BoxFuture<'_, StoreResult<Vec<Quarantined>>>;

    /// Forgets files that were noted: they have a job, or they are gone.
    fn release<'a>(&'a self, jobs: &'a [JobId]) -> BoxFuture<'a, StoreResult<()>>;

    /// Has no other job get a copy of the result of this one.
    fn spoil(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>>;

    /// Writes something, so that whoever asks knows that records can be written.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;
}
