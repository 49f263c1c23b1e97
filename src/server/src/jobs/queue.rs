//! The queue as clients see it: jobs are read, watched, awaited, ended, retried and removed.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

use tokio::sync::{Notify, OnceCell, OwnedMutexGuard, OwnedSemaphorePermit, Semaphore, watch};
use tokio::time::MissedTickBehavior;
use tokio_util::bytes::Bytes;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::access::Visibility;
use super::files::output_folder;
use super::handling::Metadata;
use super::job::{Event, Job, JobId, State, WorkerId};
use super::meters;
use super::running::{MapListener, Running};
use super::settings::{Deployment, Settings};
use super::storage::{Blobs, Changed, JobStore, Listing, Queue, Reason, StoreId};
use super::store_error::StoreResult;
use super::timestamp::SteadyClock;
use super::transition::{Command, Transition};

/// Time limit for a dismissed job to end. A job that takes longer is removed later, with the expired ones.
const DISMISSAL_TIME: Duration = Duration::from_mins(1);

/// The job queue and its state in this process.
pub struct Jobs {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) blobs: Arc<dyn Blobs>,
    pub(super) settings: Settings,
    pub(super) worker: WorkerId,
    pub(super) live: LiveEvents,
    pub(super) running: Running,
    pub(super) wake: Notify,
    pub(super) wake_reserve: Notify,
    pub(super) tasks: TaskTracker,
    pub(super) engine: OnceCell<String>,
    pub(super) draining: AtomicBool,
    pub(super) identity: OnceCell<StoreId>,
    pub(super) clock: SteadyClock,
    pub(super) has_told_wait: AtomicBool,
    pub(super) drawing: DrawingQueue,
}

/// Outcome of waiting for a job.
#[derive(Debug)]
pub enum Ended {
    /// The job is in a final state.
    Yes(Job),
    /// The time limit came first.
    NotYet(Job),
}

impl Jobs {
    /// Creates a queue on these stores. Nothing runs before [`Jobs::recover`] and [`Jobs::run`].
    pub fn new(settings: Settings, store: Arc<dyn JobStore>, blobs: Arc<dyn Blobs>) -> Self {
        Self {
            drawing: DrawingQueue::new(&settings),
            store,
            blobs,
            settings,
            worker: WorkerId::fresh(),
            live: LiveEvents::default(),
            running: Running::default(),
            wake: Notify::new(),
            wake_reserve: Notify::new(),
            tasks: TaskTracker::new(),
            engine: OnceCell::new(),
            draining: AtomicBool::new(false),
            identity: OnceCell::new(),
            clock: SteadyClock::default(),
            has_told_wait: AtomicBool::new(false),
        }
    }

    /// Returns the limits of this queue.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the record of a job, with live progress if it runs in this process.
    pub async fn get(&self, visibility: &Visibility, id: JobId) -> StoreResult<Option<Job>> {
        let running = self.running.attempt(id);
        let mut job = self.store.get(visibility, id).await?;
        if let (Some(job), Some(running)) = (&mut job, running) {
            let event = running.event();
            if job.state == State::Running && job.token == running.token && job.seq < event.seq {
                job.seq = event.seq;
                job.progress = event.progress;
            }
        }
        Ok(job)
    }

    /// Returns whether there was such a job until it expired.
    pub async fn has_expired(&self, visibility: &Visibility, id: JobId) -> StoreResult<bool> {
        self.store.has_expired(visibility, id).await
    }

    /// Returns a page of jobs.
    pub async fn list(&self, visibility: &Visibility, listing: &Listing) -> StoreResult<Vec<Job>> {
        self.store.list(visibility, listing).await
    }

    /// Returns the number of jobs in each state, and the wait of the oldest queued job.
    pub async fn queue(&self) -> StoreResult<Queue> {
        self.store.queue().await
    }

    /// Waits for the end of a job, up to `at_most`. Returns `None` if there is no such job.
    pub async fn wait(
        &self,
        visibility: &Visibility,
        id: JobId,
        at_most: Duration,
    ) -> StoreResult<Option<Ended>> {
        let Some(mut events) = self.subscribe(visibility, id).await? else {
            return Ok(None);
        };
        let end = async { while events.next().await.is_some() {} };
        let _ = tokio::time::timeout(at_most, end).await;
        let job = self.get(visibility, id).await?;
        Ok(job.map(|job| {
            if job.state.is_final() {
                Ended::Yes(job)
            } else {
                Ended::NotYet(job)
            }
        }))
    }

    /// Cancels a job, ends it early with its current map, or retries it, wherever it runs.
    pub async fn command(
        &self,
        visibility: &Visibility,
        id: JobId,
        command: Command,
    ) -> StoreResult<Changed> {
        // Tell a child of this process first, so that it does not wait for the store.
        self.running.command(visibility, id, command);
        let commanded = Transition::Commanded(command);
        let changed = self.store.change(visibility, id, &commanded).await?;
        if let Changed::Yes(job) = &changed {
            self.tell(job).await;
        }
        Ok(changed)
    }

    /// Replaces the metadata of a job.
    pub async fn note(
        &self,
        visibility: &Visibility,
        id: JobId,
        metadata: Metadata,
    ) -> StoreResult<Changed> {
        let noted = Transition::Noted(metadata);
        self.store.change(visibility, id, &noted).await
    }

    /// Removes a job in a final state with its files. Returns `false` if there is none.
    pub async fn remove(
        &self,
        visibility: &Visibility,
        id: JobId,
        reason: Reason,
    ) -> StoreResult<bool> {
        let removed = self.store.delete(visibility, id, reason).await?;
        if removed {
            self.blobs.remove(&id.to_string()).await?;
            self.live.forget(id);
        }
        Ok(removed)
    }

    /// Cancels a job and removes it, in the background, because nobody waits for it any more.
    pub fn dismiss(self: &Arc<Self>, id: JobId) {
        let jobs = Arc::clone(self);
        self.tasks.spawn(async move {
            let dismissed = async {
                jobs.command(&Visibility::All, id, Command::Cancel).await?;
                jobs.wait(&Visibility::All, id, DISMISSAL_TIME).await?;
                jobs.remove(&Visibility::All, id, Reason::Deleted).await
            };
            if let Err(error) = dismissed.await {
                tracing::error!(job = %id, %error, "not removed");
            }
        });
    }

    /// Notifies watchers and idle workers of a changed record, and removes the files that it no longer needs.
    pub(super) async fn tell(&self, job: &Job) {
        meters::finished(job);
        if let Err(error) = self.remove_unneeded(job).await {
            tracing::error!(job = %job.id, %error, "files that no job needs not removed");
        }
        self.live.publish(job.id, job.event());
        if job.state == State::Queued {
            self.wake_lanes();
        }
    }

    /// Wakes this process to look for jobs that can start.
    pub(super) fn wake_lanes(&self) {
        self.wake.notify_one();
        self.wake_reserve.notify_one();
    }

    /// Removes unneeded files: all of a cancelled job, and those of lost attempts of a finished one.
    async fn remove_unneeded(&self, job: &Job) -> StoreResult<()> {
        match job.state {
            State::Cancelled => return self.blobs.remove(&job.id.to_string()).await,
            State::Succeeded | State::Failed if 0 < job.lost + job.interrupted => {
                for token in 1..=job.token {
                    let has_result = job.state == State::Succeeded && token == job.token;
                    if !has_result {
                        self.blobs.remove(&output_folder(job.id, token)).await?;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }
}

// Scheduling of picture drawing in this process.

/// Limits drawing to one picture per job, and to a number of children at a time.
pub(super) struct DrawingQueue {
    /// Locks of jobs with a picture being drawn or waiting. Later requests wait, then find it drawn.
    turns: Mutex<HashMap<JobId, Weak<tokio::sync::Mutex<()>>>>,
    /// Slots for drawing children: half of the cores, so that jobs keep the rest.
    places: Arc<Semaphore>,
}

impl DrawingQueue {
    pub fn new(settings: &Settings) -> Self {
        Self {
            turns: Mutex::default(),
            places: Arc::new(Semaphore::new((settings.cores / 2).max(1))),
        }
    }

    /// Waits until no picture of the job is being drawn.
    pub async fn turn(&self, id: JobId) -> OwnedMutexGuard<()> {
        let turn = {
            let mut turns = self.turns.lock().unwrap_or_else(PoisonError::into_inner);
            turns.retain(|_, turn| 0 < turn.strong_count());
            let known = turns.get(&id).and_then(Weak::upgrade);
            known.unwrap_or_else(|| {
                let turn = Arc::default();
                turns.insert(id, Arc::downgrade(&turn));
                turn
            })
        };
        turn.lock_owned().await
    }

    /// Waits for a drawing slot.
    pub async fn place(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.places).acquire_owned().await.ok()
    }
}

// Events of jobs that have subscribers in this process.

/// The newest event of each job with subscribers.
#[derive(Default)]
pub(super) struct LiveEvents {
    watched: Mutex<HashMap<JobId, watch::Sender<Option<Event>>>>,
}

impl LiveEvents {
    fn watched(&self) -> MutexGuard<'_, HashMap<JobId, watch::Sender<Option<Event>>>> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Subscribes to a job.
    pub fn subscribe(&self, id: JobId) -> Subscription {
        let mut watched = self.watched();
        Subscription::new(watched.entry(id).or_default().subscribe())
    }

    /// Publishes an event of a job unless it is outdated. A final event is the last one.
    pub fn publish(&self, id: JobId, event: Event) {
        let mut watched = self.watched();
        if let Some(sender) = watched.get(&id) {
            sender.send_if_modified(|last| {
                let is_newer = last.is_none_or(|last| {
                    last.seq < event.seq || !last.state.is_final() && event.state.is_final()
                });
                if is_newer {
                    *last = Some(event);
                }
                is_newer
            });
            if event.state.is_final() {
                watched.remove(&id);
            }
        }
    }

    /// Ends the subscriptions to a job that no longer exists.
    pub fn forget(&self, id: JobId) {
        self.watched().remove(&id);
    }

    /// Returns the jobs with subscribers.
    pub fn ids(&self) -> Vec<JobId> {
        let mut watched = self.watched();
        watched.retain(|_, sender| 0 < sender.receiver_count());
        watched.keys().copied().collect()
    }
}

// Draining a process, and pausing the queue.

impl Jobs {
    /// Starts or stops draining: a draining process neither accepts nor starts jobs, but finishes those it has.
    pub fn set_draining(&self, draining: bool) {
        self.draining.store(draining, Ordering::Relaxed);
        tracing::info!(draining, "drain");
        self.wake_lanes();
    }

    /// Returns whether the process is draining.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }

    /// Pauses or resumes the queue: while it is paused, no process starts jobs, but all still accept them.
    pub async fn set_paused(&self, paused: bool) -> StoreResult<()> {
        self.store.set_paused(paused).await?;
        tracing::info!(paused, "pause");
        self.wake_lanes();
        Ok(())
    }

    /// Returns whether the queue is paused.
    pub async fn is_paused(&self) -> StoreResult<bool> {
        self.store.is_paused().await
    }

    /// Returns the number of jobs that this process is computing.
    pub fn running(&self) -> usize {
        self.running.heartbeats().len()
    }
}

// Watching of jobs, wherever they run.

/// Number of lookups of the attempt at a job that was just claimed, and the interval between them. The record says
/// `running` a moment before the attempt is registered here. If another process computes the job, the request waits
/// for all lookups in vain: a quarter of a second.
const LOOKUPS: usize = 5;
const LOOKUP_INTERVAL: Duration = Duration::from_millis(50);

/// Answer to a request for the maps of a running job.
pub enum NextMaps {
    /// The bytes of a frame.
    Frame(Bytes),
    /// The attempt has ended.
    Over,
    /// Another process computes the job.
    Elsewhere,
}

impl Jobs {
    /// Subscribes to a job; `None` if there is no such job.
    pub async fn subscribe(
        &self,
        visibility: &Visibility,
        id: JobId,
    ) -> StoreResult<Option<Subscription>> {
        // Subscribe before reading the record, so that no event between the two is missed.
        let subscription = self.live.subscribe(id);
        // Do not end the events of a job outside the caller's scope: others may watch it.
        let Some(job) = self.get(visibility, id).await? else {
            return Ok(None);
        };
        self.live.publish(id, job.event());
        Ok(Some(subscription))
    }

    /// Waits for the next frame of maps after `after`. Frames are only available in the process that computes the
    /// job.
    pub async fn next_maps(&self, id: JobId, after: u64) -> NextMaps {
        let Some(listener) = self.map_listener(id).await else {
            return match self.settings.deployment {
                Deployment::Embedded => NextMaps::Over,
                Deployment::Shared => NextMaps::Elsewhere,
            };
        };
        (listener.next(after).await).map_or(NextMaps::Over, NextMaps::Frame)
    }

    async fn map_listener(&self, id: JobId) -> Option<MapListener> {
        for _ in 0..LOOKUPS {
            if let Some(attempt) = self.running.attempt(id) {
                return Some(attempt.maps.listener());
            }
            tokio::time::sleep(LOOKUP_INTERVAL).await;
        }
        None
    }

    /// Polls the records of watched jobs until stopped.
    pub(super) async fn watch_until(&self, stop: &CancellationToken) {
        let mut interval = tokio::time::interval(self.settings.deployment.poll_interval());
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            let ids = self.live.ids();
            if ids.is_empty() {
                continue;
            }
            match self.store.events(&ids).await {
                Ok(events) => {
                    let events: HashMap<_, _> = events.into_iter().collect();
                    for id in ids {
                        match events.get(&id) {
                            Some(&event) => self.live.publish(id, event),
                            None => self.live.forget(id),
                        }
                    }
                }
                Err(error) => tracing::warn!(%error, "records of watched jobs not read"),
            }
        }
    }
}

// A listener's view of a job's events.

/// Subscription to the events of one job. A slow reader skips events.
pub struct Subscription {
    receiver: watch::Receiver<Option<Event>>,
    last: Last,
}

/// The last event delivered.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    /// No event yet.
    None,
    /// An event with this number.
    Seq(u64),
    /// A final event.
    Final,
}

impl Subscription {
    pub(super) fn new(receiver: watch::Receiver<Option<Event>>) -> Self {
        Self {
            receiver,
            last: Last::None,
        }
    }

    /// Skips events up to and including this number, except a final one.
    #[must_use]
    pub fn after(mut self, seq: Option<u64>) -> Self {
        self.last = seq.map_or(Last::None, Last::Seq);
        self
    }

    /// Waits for the next event newer than the last one. Returns `None` after a final event, or when the job is
    /// removed.
    pub async fn next(&mut self) -> Option<Event> {
        while self.last != Last::Final {
            let event = *self.receiver.borrow_and_update();
            if let Some(event) = event.filter(|event| self.is_new(event)) {
                self.last = if event.state.is_final() {
                    Last::Final
                } else {
                    Last::Seq(event.seq)
                };
                return Some(event);
            }
            self.receiver.changed().await.ok()?;
        }
        None
    }

    fn is_new(&self, event: &Event) -> bool {
        match self.last {
            Last::None => true,
            Last::Seq(seq) => seq < event.seq || event.state.is_final(),
            Last::Final => false,
        }
    }
}
