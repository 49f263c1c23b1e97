//! What one listener sees of a job's events.

use tokio::sync::watch;

use super::progress::Event;

/// A view on the events of one job. Whoever is slow misses the ones between.
pub struct Subscription {
    receiver: watch::Receiver<Option<Event>>,
    last: Last,
}

/// What was seen last.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    /// Nothing.
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

    /// The next event that is newer than the last one; `None` after a final event, or when the job
    /// is removed.
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
