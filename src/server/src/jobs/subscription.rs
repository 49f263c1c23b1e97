//! A listener's view of a job's events.

use tokio::sync::watch;

use super::progress::Event;

/// Subscription to the events of one job. A slow reader skips events.
pub struct Subscription {
    receiver: watch::Receiver<Option<Event>>,
    last: Last,
}

/// The last event delivered.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    /// No event yet.
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

    /// Waits for the next event newer than the last one. Returns `None` after a final event, or when the job is
    /// removed.
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
