//! Events of jobs that somebody watches in this process.
//!
//! An attempt that runs here tells its events itself. All others are seen in the records, which
//! are read again and again: that works whichever process runs the job.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::job::JobId;
use super::progress::Event;
use super::queue::Jobs;
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
    fn ids(&self) -> Vec<JobId> {
        let mut watched = self.watched();
        watched.retain(|_, sender| 0 < sender.receiver_count());
        watched.keys().copied().collect()
    }
}

impl Jobs {
    /// Watches a job; `None` if there is none.
    pub async fn subscribe(&self, id: JobId) -> super::StoreResult<Option<Subscription>> {
        // What happens after this line is seen, so that no end can fall between it and the record.
        let subscription = self.live.subscribe(id);
        let Some(job) = self.get(id).await? else {
            self.live.forget(id);
            return Ok(None);
        };
        self.live.publish(id, job.event());
        Ok(Some(subscription))
    }

    /// Reads the records of watched jobs from time to time until told to stop.
    pub(super) async fn watch_until(&self, stop: &CancellationToken) {
        let mut interval = tokio::time::interval(self.settings.deployment.look_interval());
        interval.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
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
