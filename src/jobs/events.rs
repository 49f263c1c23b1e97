//! Events within one process.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::job::JobId;
use super::progress::Event;
use super::storage::Events;

/// Events of live jobs, kept in memory: the newest of each.
#[derive(Default)]
pub struct LocalEvents {
    live: Mutex<HashMap<JobId, watch::Sender<Event>>>,
}

impl LocalEvents {
    fn live(&self) -> MutexGuard<'_, HashMap<JobId, watch::Sender<Event>>> {
        self.live.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Events for LocalEvents {
    fn announce(&self, id: JobId, event: Event) {
        self.live().insert(id, watch::Sender::new(event));
    }

    fn publish(&self, id: JobId, event: Event) {
        let mut live = self.live();
        let is_final = event.state.is_final();
        if let Some(sender) = live.get(&id) {
            sender.send_replace(event);
        }
        if is_final {
            live.remove(&id);
        }
    }

    fn subscribe(&self, id: JobId) -> Option<Subscription> {
        let receiver = self.live().get(&id)?.subscribe();
        Some(Subscription {
            receiver,
            last_seq: None,
        })
    }

    fn forget(&self, id: JobId) {
        self.live().remove(&id);
    }
}

/// A view on the events of one job. Whoever is slow misses the ones between.
pub struct Subscription {
    receiver: watch::Receiver<Event>,
    last_seq: Option<u64>,
}

impl Subscription {
    /// Skips events up to and including this number, except a final one.
    #[must_use]
    pub fn after(mut self, seq: Option<u64>) -> Self {
        self.last_seq = seq;
        self
    }

    /// The newest event, without waiting.
    pub fn latest(&self) -> Event {
        *self.receiver.borrow()
    }

    /// The next event that is newer than the last one; `None` after a final event.
    pub async fn next(&mut self) -> Option<Event> {
        loop {
            let event = *self.receiver.borrow_and_update();
            let is_newer = self.last_seq.is_none_or(|last| last < event.seq);
            if is_newer || (event.state.is_final() && self.last_seq != Some(u64::MAX)) {
                self.last_seq = Some(if event.state.is_final() {
                    u64::MAX
                } else {
                    event.seq
                });
                return Some(event);
            }
            self.receiver.changed().await.ok()?;
        }
    }
}
