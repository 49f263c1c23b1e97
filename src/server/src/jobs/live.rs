//! Events of jobs that somebody watches in this process.
//!
//! An attempt that runs here tells its events itself. All others are seen in the records, which
//! are read again and again: that works whichever process runs the job.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::job::JobId;
use super::progress::Event;
use super::subscription::Subscription;

/// The newest event of each job that somebody watches.
#[derive(Default)]
pub(super) struct Live {
    watched: Mutex<HashMap<JobId, watch::Sender<Option<Event>>>>,
}

impl Live {
    fn watched(&self) -> MutexGuard<'_, HashMap<JobId, watch::Sender<Option<Event>>>> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Watches a job from now on.
    pub fn subscribe(&self, id: JobId) -> Subscription {
        let mut watched = self.watched();
        Subscription::new(watched.entry(id).or_default().subscribe())
    }

    /// Tells those who watch a job about a newer event. After a final one there are no more.
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

    /// There is no such job any more: nobody has to wait for it.
    pub fn forget(&self, id: JobId) {
        self.watched().remove(&id);
    }

    /// The jobs that somebody watches.
    pub fn ids(&self) -> Vec<JobId> {
        let mut watched = self.watched();
        watched.retain(|_, sender| 0 < sender.receiver_count());
        watched.keys().copied().collect()
    }
}
