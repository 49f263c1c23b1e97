//! The worker: starts attempts as jobs arrive, and sends their heartbeats.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use futures_util::future::join_all;
use tokio::sync::{Notify, OwnedSemaphorePermit, Semaphore};
use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::job::Job;
use super::queue::Jobs;
use super::running::RunningAttempt;
use super::settings::Settings;
use super::storage::Share;
use super::{attempt, meters};

/// Delay before asking a failed store again. Longer delays leave slots idle after a short outage; shorter ones burden
/// a store that is recovering.
const STORE_RETRY: Duration = Duration::from_secs(1);

/// A claimed job with its slot.
struct Claimed {
    slot: OwnedSemaphorePermit,
    job: Job,
    attempt: Arc<RunningAttempt>,
}

impl Jobs {
    /// Starts attempts as jobs arrive and slots are free, and keeps the store in order. When stopped, claims no more
    /// jobs, gives running attempts the grace period to finish, hands back the jobs of the rest, and returns.
    pub async fn run(self: Arc<Self>, stop: CancellationToken) {
        // Start the background tasks: retention, sweeping, watching, hints, heartbeats.
        let upkeep = Arc::clone(&self);
        let stopped = stop.clone();
        self.tasks
            .spawn(async move { upkeep.keep_until(&stopped).await });
        let sweeper = Arc::clone(&self);
        let stopped = stop.clone();
        self.tasks
            .spawn(async move { sweeper.sweep_until(&stopped).await });
        let watcher = Arc::clone(&self);
        let stopped = stop.clone();
        self.tasks
            .spawn(async move { watcher.watch_until(&stopped).await });
        let hinted = Arc::clone(&self);
        let stopped = stop.clone();
        self.tasks
            .spawn(async move { hinted.wake_until(&stopped).await });
        let sender = Arc::clone(&self);
        let interval = (self.settings.deployment).heartbeat_interval(&self.settings.rules);
        let heartbeats = tokio::spawn(async move { sender.send_heartbeats(interval).await });

        let reader = Arc::clone(&self);
        // Hash the program now, or the first job would wait for it.
        self.tasks
            .spawn(async move { reader.engine().await.map(drop) });

        // Claim jobs in every lane until told to stop.
        let (leave, attempts) = (CancellationToken::new(), TaskTracker::new());
        let lanes = Lane::all(&self.settings);
        let started = lanes.iter();
        let started = started.map(|lane| self.start_in(lane, &leave, &attempts, &stop));
        join_all(started).await;
        // Let running attempts finish, then hand back the rest.
        attempts.close();
        if tokio::time::timeout(self.settings.grace, attempts.wait())
            .await
            .is_err()
        {
            leave.cancel();
            attempts.wait().await;
        }
        heartbeats.abort();
        self.tasks.close();
        self.tasks.wait().await;
    }

    /// Starts attempts as jobs arrive and slots of a lane are free, until told to stop.
    async fn start_in(
        self: &Arc<Self>,
        lane: &Lane,
        leave: &CancellationToken,
        attempts: &TaskTracker,
        stop: &CancellationToken,
    ) {
        while let Some(claimed) = self.next(lane, stop).await {
            let (jobs, leave, stop) = (Arc::clone(self), leave.clone(), stop.clone());
            attempts.spawn(async move {
                let Claimed { slot, job, attempt } = claimed;
                let rest = attempt::run_logged(&jobs, job, &attempt, &leave).await;
                tokio::select! {
                    () = tokio::time::sleep(rest) => {}
                    () = stop.cancelled() => {}
                }
                drop(slot);
            });
        }
    }

    /// Looks for jobs whenever the store hints at one, until told to stop.
    async fn wake_until(&self, stop: &CancellationToken) {
        loop {
            tokio::select! {
                () = self.store.hint() => self.wake_lanes(),
                () = stop.cancelled() => return,
            }
        }
    }

    /// Waits for a slot, space and a job, and claims the job. Returns `None` after a stop.
    async fn next(&self, lane: &Lane, stop: &CancellationToken) -> Option<Claimed> {
        // Wait for a free slot.
        let bell = lane.bell(&self.wake, &self.wake_reserve);
        let slot = tokio::select! {
            slot = Arc::clone(&lane.slots).acquire_owned() => slot.ok()?,
            () = stop.cancelled() => return None,
        };
        lane.set_free(true);
        while !stop.is_cancelled() {
            let sent = Instant::now();
            // Claim a job, unless space is short, the process drains, or a suspect runs alone.
            let claimed = match self.has_room() {
                Ok(()) if self.is_draining() || !lane.is_open() => Ok(None),
                Ok(()) if self.running.has_suspect() => Ok(None),
                Ok(()) => {
                    let is_busy = 0 < self.running.len();
                    let share = Share {
                        is_busy,
                        ..lane.share
                    };
                    self.store.claim(self.worker, share).await
                }
                Err(error) => Err(error),
            };
            // Start the job, or find out how long to wait.
            let pause = match claimed {
                Ok(Some(job)) => {
                    let attempt = attempt::started(self, &job, sent);
                    // If this was the last slot, the reserve lane opens.
                    lane.set_free(false);
                    self.wake_reserve.notify_one();
                    return Some(Claimed { slot, job, attempt });
                }
                Ok(None) => self.settings.deployment.poll_interval(),
                Err(error) => {
                    meters::store_failed();
                    tracing::error!(%error, "no job claimed");
                    STORE_RETRY
                }
            };
            tokio::select! {
                // Wait for a wake-up, the next look or the stop.
                () = bell.notified() => {}
                () = tokio::time::sleep(pause) => {}
                () = stop.cancelled() => return None,
            }
        }
        None
    }
}

// Lanes of a process: slots for all jobs, and one reserved for small jobs.

/// Slots, and the jobs that may take them.
struct Lane {
    pub slots: Arc<Semaphore>,
    pub share: Share,
    is_reserve: bool,
    /// Set while a free slot of the main lane waits for a job.
    is_any_free: Arc<AtomicBool>,
}

impl Lane {
    /// Returns the lanes of a process.
    pub fn all(settings: &Settings) -> Vec<Self> {
        let is_any_free = Arc::new(AtomicBool::new(true));
        let share = Share {
            largest: None,
            of_owner: settings.owner_running,
            is_busy: false,
        };
        let small = settings.small.filter(|_| 0 < settings.workers);
        let reserve = small.map(|small| Self {
            slots: Arc::new(Semaphore::new(1)),
            share: Share {
                largest: Some(small),
                ..share
            },
            is_reserve: true,
            is_any_free: Arc::clone(&is_any_free),
        });
        let main = Self {
            slots: Arc::new(Semaphore::new(settings.workers)),
            share,
            is_reserve: false,
            is_any_free,
        };
        std::iter::once(main).chain(reserve).collect()
    }

    /// Returns whether jobs may start in this lane now.
    pub fn is_open(&self) -> bool {
        !self.is_reserve || !self.is_any_free.load(Ordering::Relaxed)
    }

    /// Records whether a slot of this lane is free.
    pub fn set_free(&self, is_free: bool) {
        if !self.is_reserve {
            self.is_any_free.store(is_free, Ordering::Relaxed);
        }
    }

    /// Returns the notifier of this lane.
    pub fn bell<'a>(&self, main: &'a Notify, reserve: &'a Notify) -> &'a Notify {
        if self.is_reserve { reserve } else { main }
    }
}

// Heartbeats, which also carry client commands back to the attempts.

impl Jobs {
    /// Sends heartbeats for all attempts of this process every `interval`, and passes the answers on to them. Never
    /// returns.
    pub(super) async fn send_heartbeats(&self, interval: Duration) {
        let mut interval = tokio::time::interval(interval);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            interval.tick().await;
            let heartbeats = self.running.heartbeats();
            if heartbeats.is_empty() {
                continue;
            }
            let lease_end = Instant::now() + self.settings.rules.lease;
            match self.store.heartbeat(&heartbeats).await {
                Ok(answers) => {
                    for (heartbeat, changed) in heartbeats.iter().zip(&answers) {
                        self.running.answered(heartbeat, changed, lease_end);
                    }
                }
                Err(error) => {
                    meters::store_failed();
                    tracing::warn!(%error, "no sign of life given");
                }
            }
        }
    }
}
