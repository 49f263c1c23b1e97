//! Stores that fail by name: a call of this name is not done, or done and not answered, or the last
//! that the process does.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use futures_util::FutureExt;
use futures_util::future::{BoxFuture, pending};
use tokio::sync::Notify;
use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{
    Blobs, Capacity, Census, Changed, Content, Enqueued, Event, Heartbeat, IdempotencyKey, Job,
    JobId, JobStore, Listing, Quarantined, Queue, Reason, Share, StoreError, StoreId, StoreResult,
    Sweep, Timestamp, Transition, WorkerId,
};

/// What becomes of a call.
#[derive(Clone, Copy, Debug)]
pub enum How {
    /// It is not done, and says so.
    Refused,
    /// It is done, and the answer is lost.
    Unanswered,
    /// It is never done, and nothing comes back: the process dies before it.
    Before,
    /// It is done, and nothing comes back: the process dies after it.
    After,
}

/// Which calls fail, and how.
pub struct Fault {
    name: &'static str,
    how: How,
    /// Calls of the name before them, and how many they are.
    skipped: AtomicUsize,
    left: AtomicUsize,
    /// One has come that will not be answered.
    pub reached: Notify,
}

impl Fault {
    /// None fail.
    pub fn none() -> Arc<Self> {
        Self::of("", How::Refused, 0, 0)
    }

    /// The first call of a name fails.
    pub fn first(name: &'static str, how: How) -> Arc<Self> {
        Self::of(name, how, 0, 1)
    }

    /// So many calls of a name fail, after so many that do not.
    pub fn of(name: &'static str, how: How, skipped: usize, count: usize) -> Arc<Self> {
        Arc::new(Self {
            name,
            how,
            skipped: AtomicUsize::new(skipped),
            left: AtomicUsize::new(count),
            reached: Notify::new(),
        })
    }

    /// Whether all that were to fail have failed.
    pub fn has_happened(&self) -> bool {
        self.left.load(Ordering::SeqCst) == 0
    }

    fn meets(&self, name: &str) -> bool {
        let one_less = |count: usize| count.checked_sub(1);
        let take = |from: &AtomicUsize| {
            let taken = from.fetch_update(Ordering::SeqCst, Ordering::SeqCst, one_less);
            taken.is_ok()
        };
        name == self.name && !take(&self.skipped) && take(&self.left)
    }

    fn call<'a, T: Send + 'a>(
        &'a self,
        name: &'static str,
        call: BoxFuture<'a, StoreResult<T>>,
    ) -> BoxFuture<'a, StoreResult<T>> {
        async move {
            if !self.meets(name) {
                return call.await;
            }
            match self.how {
                How::Refused => return Err(StoreError::Unavailable(name.to_owned())),
                How::Unanswered => {
                    call.await?;
                    return Err(StoreError::Unanswered(name.to_owned()));
                }
                How::Before => {}
                How::After => drop(call.await?),
            }
            self.reached.notify_one();
            pending().await
        }
        .boxed()
    }
}

/// Records or files, calls of which fail.
pub struct Faulty<S> {
    pub inner: S,
    pub fault: Arc<Fault>,
}

impl<S: JobStore> JobStore for Faulty<S> {
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>> {
        let call = self.inner.enqueue(job, key, capacity);
        self.fault.call("enqueue", call)
    }

    fn get<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<Option<Job>>> {
        self.inner.get(visibility, id)
    }

    fn list<'a>(
        &'a self,
        visibility: &'a Visibility,
        listing: &'a Listing,
    ) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        self.inner.list(visibility, listing)
    }

    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>> {
        self.inner.events(ids)
    }

    fn equal<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        self.inner.equal(job)
    }

    fn hint(&self) -> BoxFuture<'_, ()> {
        self.inner.hint()
    }

    fn claim(&self, worker: WorkerId, share: Share) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        self.fault.call("claim", self.inner.claim(worker, share))
    }

    fn set_paused(&self, paused: bool) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.set_paused(paused)
    }

    fn is_paused(&self) -> BoxFuture<'_, StoreResult<bool>> {
        self.inner.is_paused()
    }

    fn ended_within(&self, time: Duration) -> BoxFuture<'_, StoreResult<u64>> {
        self.inner.ended_within(time)
    }

    fn change<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        transition: &'a Transition,
    ) -> BoxFuture<'a, StoreResult<Changed>> {
        let call = self.inner.change(visibility, id, transition);
        self.fault.call("change", call)
    }

    fn heartbeat<'a>(
        &'a self,
        heartbeats: &'a [Heartbeat],
    ) -> BoxFuture<'a, StoreResult<Vec<Changed>>> {
        self.fault.call("beat", self.inner.heartbeat(heartbeats))
    }

    fn sweep(&self, sweep: Sweep) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        self.inner.sweep(sweep)
    }

    fn delete<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        reason: Reason,
    ) -> BoxFuture<'a, StoreResult<bool>> {
        let call = self.inner.delete(visibility, id, reason);
        self.fault.call("delete", call)
    }

    fn has_expired<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<bool>> {
        self.inner.has_expired(visibility, id)
    }

    fn ended_before(&self, kept: Duration) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        self.inner.ended_before(kept)
    }

    fn forget_keys(&self) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.forget_keys()
    }

    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        self.inner.ephemeral()
    }

    fn queue(&self) -> BoxFuture<'_, StoreResult<Queue>> {
        self.inner.queue()
    }

    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>> {
        self.inner.stored_bytes()
    }

    fn now(&self) -> BoxFuture<'_, StoreResult<Timestamp>> {
        self.inner.now()
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        self.inner.identity()
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<StoreId>> {
        self.inner.identify(identity)
    }

    fn census(&self) -> BoxFuture<'_, StoreResult<Census>> {
        self.inner.census()
    }

    fn quarantine<'a>(&'a self, files: &'a [(JobId, u64)]) -> BoxFuture<'a, StoreResult<()>> {
        self.inner.quarantine(files)
    }

    fn quarantined(&self) -> BoxFuture<'_, StoreResult<Vec<Quarantined>>> {
        self.inner.quarantined()
    }

    fn release<'a>(&'a self, jobs: &'a [JobId]) -> BoxFuture<'a, StoreResult<()>> {
        self.inner.release(jobs)
    }

    fn spoil(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.spoil(id)
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.check()
    }
}

impl Blobs for Faulty<Box<dyn Blobs>> {
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        self.fault.call("put", self.inner.put(key, from))
    }

    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        self.fault.call("copy", self.inner.copy(from, to))
    }

    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        self.fault.call("fetch", self.inner.fetch(key, to))
    }

    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>> {
        self.inner.read(key, range)
    }

    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        self.inner.owners()
    }

    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>> {
        self.inner.list(folder)
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        self.inner.identity()
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.identify(identity)
    }

    fn free_bytes(&self) -> StoreResult<Option<u64>> {
        self.inner.free_bytes()
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        self.inner.check()
    }

    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        self.fault.call("remove", self.inner.remove(folder))
    }
}
