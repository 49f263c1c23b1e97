//! The queue: takes jobs in, starts attempts, lets clients watch, cancel and remove.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::Notify;
use tokio_util::task::TaskTracker;

use super::control::Control;
use super::job::{Failure, Job, JobId, OutputFile};
use super::keys::output_key;
use super::settings::Settings;
use super::state::State;
use super::storage::{Blobs, Events, JobStore, Listing, Wish};
use super::store_error::StoreResult;
use super::subscription::Subscription;
use super::timestamp::Timestamp;

/// After this many crashes of the server during its computation, a job is taken for the cause.
const MAX_LOST: u32 = 3;
/// For a job that nobody waits for to end.
const DISMISSAL_TIME: Duration = Duration::from_mins(1);

/// The queue and all that belongs to it.
pub struct Jobs {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) blobs: Arc<dyn Blobs>,
    pub(super) events: Arc<dyn Events>,
    pub(super) settings: Settings,
    pub(super) wake: Notify,
    controls: Mutex<HashMap<JobId, Control>>,
    pub(super) tasks: TaskTracker,
}

/// Whether a wait saw the end of the job.
#[derive(Debug)]
pub enum Ended {
    /// It is in a final state.
    Yes(Job),
    /// Time was over first.
    NotYet(Job),
}

impl Jobs {
    /// A queue on these stores. Nothing runs before [`Jobs::recover`] and [`Jobs::run`].
    pub fn new(
        settings: Settings,
        store: Arc<dyn JobStore>,
        blobs: Arc<dyn Blobs>,
        events: Arc<dyn Events>,
    ) -> Self {
        Self {
            store,
            blobs,
            events,
            settings,
            wake: Notify::new(),
            controls: Mutex::default(),
            tasks: TaskTracker::new(),
        }
    }

    /// The limits of this queue.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Puts the house in order after a start: scratch is emptied, jobs that ran when the server was lost are queued
    /// again (or failed, when that happened too often), calls that nobody waits for any more are forgotten, and files
    /// without a job are removed.
    pub async fn recover(&self) -> StoreResult<()> {
        let scratch = &self.settings.scratch;
        if tokio::fs::try_exists(scratch).await? {
            tokio::fs::remove_dir_all(scratch).await?;
        }
        tokio::fs::create_dir_all(scratch).await?;
        for mut job in self.store.recover().await? {
            if job.ephemeral {
                self.store.delete(job.id).await?;
                self.blobs.remove(job.id).await?;
            } else if job.lost >= MAX_LOST {
                let detail = format!("the server stopped {MAX_LOST} times during the computation");
                job.state = State::Failed;
                job.failure = Some(Failure::new("worker_lost", detail));
                job.finished = Some(Timestamp::now());
                self.store.update(&job).await?;
            } else {
                self.make_live(&job);
            }
        }
        self.remove_orphaned_files().await
    }

    /// The job as it is now, its progress included.
    pub async fn get(&self, id: JobId) -> StoreResult<Option<Job>> {
        let live = self.events.subscribe(id);
        let mut job = self.store.get(id).await?;
        if let (Some(job), Some(live)) = (&mut job, live) {
            let event = live.latest();
            if job.state == State::Running && job.seq < event.seq {
                job.seq = event.seq;
                job.progress = event.progress;
            }
        }
        Ok(job)
    }

    /// A page of jobs, the newest first.
    pub async fn list(&self, listing: Listing) -> StoreResult<Vec<Job>> {
        self.store.list(listing).await
    }

    /// How many jobs there are in each state.
    pub async fn counts(&self) -> StoreResult<Vec<(State, u64)>> {
        self.store.counts().await
    }

    /// Watches a live job. `None`: its record is final, or there is none.
    pub fn subscribe(&self, id: JobId) -> Option<Subscription> {
        self.events.subscribe(id)
    }

    /// Waits for the end of a job, but not longer than this.
    pub async fn wait(&self, id: JobId, at_most: Duration) -> StoreResult<Option<Ended>> {
        if let Some(mut events) = self.events.subscribe(id) {
            let end = async { while events.next().await.is_some() {} };
            let _ = tokio::time::timeout(at_most, end).await;
        }
        let job = self.get(id).await?;
        Ok(job.map(|job| {
            if job.state.is_final() {
                Ended::Yes(job)
            } else {
                Ended::NotYet(job)
            }
        }))
    }

    /// Cancels a job, or has it end early with the map it has. Returns the job after that; its state says whether it
    /// was too late.
    pub async fn wish(&self, id: JobId, wish: Wish) -> StoreResult<Option<Job>> {
        // The running child first, it should not wait for the disk; a queued job is ended by the store.
        if let Some(control) = self.control(id) {
            match wish {
                Wish::Cancel => control.cancel.cancel(),
                Wish::FinishEarly => control.finish.cancel(),
            }
        }
        let Some(job) = self.store.wish(id, wish).await? else {
            return Ok(None);
        };
        if job.state.is_final() {
            self.end(&job).await;
        }
        Ok(Some(job))
    }

    /// Removes a job in a final state, with its files.
    pub async fn remove(&self, id: JobId) -> StoreResult<()> {
        self.store.delete(id).await?;
        self.blobs.remove(id).await
    }

    /// Ends a job and removes it, in the background: nobody waits for it any more.
    pub fn dismiss(self: &Arc<Self>, id: JobId) {
        let jobs = Arc::clone(self);
        self.tasks.spawn(async move {
            let dismissed = async {
                jobs.wish(id, Wish::Cancel).await?;
                jobs.wait(id, DISMISSAL_TIME).await?;
                jobs.remove(id).await
            };
            if let Err(error) = dismissed.await {
                tracing::error!(job = %id, %error, "not removed");
            }
        });
    }

    /// Opens a file that a job made.
    pub async fn open(&self, job: &Job, file: &OutputFile) -> StoreResult<tokio::fs::File> {
        let index = job.output.iter().position(|other| other == file);
        self.blobs
            .open(&output_key(job.id, index.unwrap_or_default()))
            .await
    }

    pub(super) fn make_live(&self, job: &Job) {
        self.controls().insert(job.id, Control::default());
        self.events.announce(job.id, job.event());
    }

    /// Tells those who watch that a job has ended. Nothing but the record is kept of a cancelled one.
    pub(super) async fn end(&self, job: &Job) {
        if job.state == State::Cancelled
            && let Err(error) = self.blobs.remove(job.id).await
        {
            tracing::error!(job = %job.id, %error, "files of a cancelled job not removed");
        }
        self.controls().remove(&job.id);
        self.events.publish(job.id, job.event());
    }

    pub(super) fn forget_live(&self, id: JobId) {
        self.controls().remove(&id);
        self.events.forget(id);
    }

    pub(super) fn control(&self, id: JobId) -> Option<Control> {
        self.controls().get(&id).cloned()
    }

    fn controls(&self) -> MutexGuard<'_, HashMap<JobId, Control>> {
        self.controls.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
