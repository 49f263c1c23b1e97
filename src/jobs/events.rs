//! Events within one process.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::job::JobId;
use super::progress::Event;
use super::storage::Events;
use super::subscription::Subscription;

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
