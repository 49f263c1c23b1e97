//! What one listener sees of a job's events.

use tokio::sync::watch;

use super::progress::Event;

/// A view on the events of one job. Whoever is slow misses the ones between.
pub struct Subscription {
    pub(super) receiver: watch::Receiver<Event>,
    pub(super) last_seq: Option<u64>,
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
