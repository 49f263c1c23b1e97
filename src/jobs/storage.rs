//! What the queue needs from the world: records, files, events.

use std::path::Path;

use futures_util::future::BoxFuture;

use super::job::{Job, JobId};
use super::progress::Event;
use super::state::State;
use super::store_error::StoreResult;
use super::subscription::Subscription;
use super::timestamp::Timestamp;

/// A client's promise that two submissions with the same key are one.
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
    /// It is a new job.
    New,
    /// It was made before, under the same key.
    Replay(Box<Job>),
    /// The key was used for something else.
    KeyReused,
    /// As many jobs wait as may wait.
    Full,
    /// The files of all jobs together would take more than they may.
    OverQuota,
}

/// How much may be stored.
#[derive(Clone, Copy, Debug)]
pub struct Capacity {
    /// Jobs that may wait.
    pub depth: u32,
    /// Bytes that the files of all jobs may take when one more is accepted.
    pub bytes: Option<u64>,
}

/// Which jobs to list, the newest first.
#[derive(Clone, Copy, Debug)]
pub struct Listing {
    /// Only those in this state.
    pub state: Option<State>,
    /// Only those made before this one.
    pub before: Option<JobId>,
    /// At most so many.
    pub limit: u32,
}

/// What a client may ask of a live job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Stop; nothing is kept but the record.
    Cancel,
    /// Stop iterating and write the map as it is.
    FinishEarly,
}

/// Records of jobs. Every call is one transaction.
pub trait JobStore: Send + Sync {
    /// Stores a queued job, unless that would exceed the capacity or its key has been used.
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>>;

    /// The record of a job.
    fn get(&self, id: JobId) -> BoxFuture<'_, StoreResult<Option<Job>>>;

    /// A page of the list.
    fn list(&self, listing: Listing) -> BoxFuture<'_, StoreResult<Vec<Job>>>;

    /// Takes the oldest queued job, which becomes running with its next attempt.
    fn claim(&self) -> BoxFuture<'_, StoreResult<Option<Job>>>;

    /// Writes how far a running attempt is, for those who look after a restart.
    fn record_progress(
        &self,
        id: JobId,
        attempt: u32,
        event: Event,
    ) -> BoxFuture<'static, StoreResult<()>>;

    /// Writes how an attempt ended; false if it is not the present one any more.
    fn update<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<bool>>;

    /// Records a wish and returns the job after it. A queued job that is cancelled is so at once.
    fn wish(&self, id: JobId, wish: Wish) -> BoxFuture<'_, StoreResult<Option<Job>>>;

    /// After a loss of the server: returns all jobs that are not in a final state, the running ones put back in the
    /// queue with their `lost` counted.
    fn recover(&self) -> BoxFuture<'_, StoreResult<Vec<Job>>>;

    /// Removes a record and its idempotency key.
    fn delete(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>>;

    /// The jobs that ended before a moment.
    fn ended_before(&self, moment: Timestamp) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// How many jobs there are in each state.
    fn counts(&self) -> BoxFuture<'_, StoreResult<Vec<(State, u64)>>>;

    /// Bytes of the files of all jobs.
    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>>;

    /// Writes something, so that whoever asks knows that records can be written.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;
}

/// Files of jobs, under keys such as `ID/input/0`. A file is there completely or not at all.
pub trait Blobs: Send + Sync {
    /// Stores a local file under a key, durably. The file may be moved away.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Brings a file to a local path.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Opens a file for reading and seeking.
    fn open<'a>(&'a self, key: &'a str) -> BoxFuture<'a, StoreResult<tokio::fs::File>>;

    /// The jobs that have files.
    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Bytes that may still be written; `None` where nobody counts.
    fn free_bytes(&self) -> StoreResult<Option<u64>>;

    /// Removes all files of a job.
    fn remove(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>>;
}

/// Tells those who watch what happens to live jobs.
pub trait Events: Send + Sync {
    /// Makes a job known, with its first event; to be called before its record can be found.
    fn announce(&self, id: JobId, event: Event);

    /// Passes on a newer event; after a final one, the job is not live any more.
    fn publish(&self, id: JobId, event: Event);

    /// Watches a live job. `None`: it has ended, and its record says how, or there never was one.
    fn subscribe(&self, id: JobId) -> Option<Subscription>;

    /// Forgets a job that came to nothing.
    fn forget(&self, id: JobId);
}
