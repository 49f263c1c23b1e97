//! Events of jobs that have subscribers in this process.
//!
//! An attempt that runs here publishes its events itself. Events of all others are polled from the records, which
//! works whichever process runs the job.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::job::JobId;
use super::progress::Event;
use super::subscription::Subscription;

/// The newest event of each job with subscribers.
#[derive(Default)]
pub(super) struct Live {
    watched: Mutex<HashMap<JobId, watch::Sender<Option<Event>>>>,
}

impl Live {
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
