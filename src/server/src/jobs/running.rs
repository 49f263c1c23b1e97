//! The attempts of this process: commands to them, heartbeats from them, and frames of their maps.

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{Notify, watch};
use tokio::time::Instant;
use tokio_util::bytes::Bytes;
use tokio_util::sync::CancellationToken;

use super::access::{Owner, Visibility};
use super::job::{Event, Job, JobId, ProgressReport, SUSPECT, Token};
use super::storage::{Changed, Heartbeat};
use super::transition::Command;
use unwrapd_api::{MAPS, number_frame};

/// An attempt of this process.
pub(super) struct RunningAttempt {
    pub owner: Owner,
    pub token: Token,
    /// Set if the job was lost with several workers and must run alone.
    is_suspect: bool,
    /// Set when a client cancels the job.
    pub cancel: CancellationToken,
    /// Set when a client ends the job early with its current map.
    pub finish: CancellationToken,
    /// Set when the job belongs to another worker.
    pub outdated: CancellationToken,
    /// Feed of maps under way.
    pub maps: MapFeed,
    state: Mutex<Present>,
}

/// Progress of an attempt and the end of its lease.
struct Present {
    event: Event,
    lease_end: Instant,
    cpu_ms: u64,
}

impl RunningAttempt {
    fn state(&self) -> MutexGuard<'_, Present> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the newest event.
    pub fn event(&self) -> Event {
        self.state().event
    }

    /// Replaces the newest event.
    pub fn set_event(&self, event: Event) {
        self.state().event = event;
    }

    /// Records the processor time used so far, in milliseconds; it never decreases.
    pub fn set_cpu_ms(&self, cpu_ms: u64) {
        let mut state = self.state();
        state.cpu_ms = state.cpu_ms.max(cpu_ms);
    }

    /// Returns its progress report.
    pub fn report(&self) -> ProgressReport {
        let state = self.state();
        ProgressReport {
            seq: state.event.seq,
            progress: state.event.progress,
            cpu_ms: state.cpu_ms,
        }
    }

    /// Returns whether the lease is over, so that another worker may have the job. The lease counts from when the
    /// last renewal was sent, by the monotonic clock of this machine: by the store's clock it started later.
    pub fn has_lapsed(&self) -> bool {
        self.state().lease_end <= Instant::now()
    }
}

/// The attempts of this process by job.
#[derive(Default)]
pub(super) struct Running {
    attempts: Mutex<HashMap<JobId, Arc<RunningAttempt>>>,
}

impl Running {
    fn attempts(&self) -> MutexGuard<'_, HashMap<JobId, Arc<RunningAttempt>>> {
        self.attempts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Registers an attempt at a claimed job, whose lease lasts at least until `lease_end`.
    pub fn start(&self, job: &Job, lease_end: Instant) -> Arc<RunningAttempt> {
        let attempt = Arc::new(RunningAttempt {
            owner: job.owner.clone(),
            token: job.token,
            is_suspect: SUSPECT <= job.interrupted,
            cancel: CancellationToken::new(),
            finish: CancellationToken::new(),
            outdated: CancellationToken::new(),
            maps: MapFeed::new(job.seq),
            state: Mutex::new(Present {
                event: job.event(),
                lease_end,
                cpu_ms: 0,
            }),
        });
        if job.finish_early {
            attempt.finish.cancel();
        }
        self.attempts().insert(job.id, Arc::clone(&attempt));
        attempt
    }

    /// Removes an attempt that has ended.
    pub fn end(&self, id: JobId, token: Token) {
        let mut attempts = self.attempts();
        if attempts.get(&id).is_some_and(|it| it.token == token) {
            attempts.remove(&id);
        }
    }

    /// Returns the number of attempts.
    pub fn len(&self) -> usize {
        self.attempts().len()
    }

    /// Returns whether one of the attempts must run alone.
    pub fn has_suspect(&self) -> bool {
        self.attempts().values().any(|attempt| attempt.is_suspect)
    }

    /// Returns the attempt at a job if it runs here.
    pub fn attempt(&self, id: JobId) -> Option<Arc<RunningAttempt>> {
        self.attempts().get(&id).cloned()
    }

    /// Passes a client's command to the attempt at a job, if it runs here and is visible to the client.
    pub fn command(&self, visibility: &Visibility, id: JobId, command: Command) {
        let attempt = self.attempt(id);
        let Some(attempt) = attempt.filter(|it| visibility.covers(&it.owner)) else {
            return;
        };
        match command {
            Command::Cancel => attempt.cancel.cancel(),
            Command::FinishEarly => attempt.finish.cancel(),
            Command::Retry => {}
        }
    }

    /// Returns the heartbeats of all attempts.
    pub fn heartbeats(&self) -> Vec<Heartbeat> {
        let attempts = self.attempts();
        let heartbeats = attempts.iter();
        heartbeats
            .map(|(&id, attempt)| (id, attempt.token, attempt.report()))
            .collect()
    }

    /// Handles the answer to a heartbeat: renews the lease and passes on commands, or marks the attempt outdated.
    pub fn answered(&self, (id, token, _): &Heartbeat, changed: &Changed, lease_end: Instant) {
        let attempt = self.attempt(*id).filter(|it| it.token == *token);
        match (attempt, changed) {
            (Some(attempt), Changed::Yes(job)) => {
                attempt.state().lease_end = lease_end;
                if job.cancel {
                    attempt.cancel.cancel();
                }
                if job.finish_early {
                    attempt.finish.cancel();
                }
            }
            (Some(attempt), _) => attempt.outdated.cancel(),
            (None, _) => {}
        }
    }
}

// Frames of maps under way, passed from the compute child to its listeners.

/// The latest frame of an attempt. Slow listeners skip frames.
pub(super) struct MapFeed {
    /// Notified when a listener waits for the next frame.
    pub asked: Arc<Notify>,
    latest: watch::Sender<MapFrame>,
}

/// A numbered frame; number 0 means that there is none.
#[derive(Clone, Default)]
struct MapFrame {
    number: u64,
    bytes: Bytes,
}

/// A listener for the next frame of an attempt. It does not keep the attempt alive.
pub(super) struct MapListener {
    asked: Arc<Notify>,
    latest: watch::Receiver<MapFrame>,
}

impl MapFeed {
    /// Creates a feed whose frames have numbers above `before`.
    pub fn new(before: u64) -> Self {
        let none = MapFrame {
            number: before,
            ..MapFrame::default()
        };
        Self {
            asked: Arc::default(),
            latest: watch::Sender::new(none),
        }
    }

    /// Creates a listener.
    pub fn listener(&self) -> MapListener {
        MapListener {
            asked: Arc::clone(&self.asked),
            latest: self.latest.subscribe(),
        }
    }

    /// Publishes the frame in the folder of the attempt; does nothing if it cannot be read.
    pub async fn take(&self, folder: &Path) {
        let Ok(mut bytes) = tokio::fs::read(folder.join(MAPS)).await else {
            return;
        };
        let next = self.latest.borrow().number + 1;
        if number_frame(&mut bytes, next) {
            self.latest.send_replace(MapFrame {
                number: next,
                bytes: bytes.into(),
            });
        }
    }
}

impl MapListener {
    /// Waits for the first frame with a number above `after`, requesting one if needed. Returns `None` when the
    /// attempt has ended.
    pub async fn next(mut self, after: u64) -> Option<Bytes> {
        self.asked.notify_one();
        loop {
            let MapFrame { number, bytes } = self.latest.borrow_and_update().clone();
            if after < number && !bytes.is_empty() {
                return Some(bytes);
            }
            self.latest.changed().await.ok()?;
        }
    }
}
