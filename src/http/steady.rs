//! Bodies that keep coming.

use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::BoxError;
use axum::body::{BodyDataStream, Bytes};
use futures_util::{Stream, StreamExt};
use tokio::time::{Instant, Sleep, sleep};

/// A body that fails when it is silent for too long.
pub(super) struct Steady {
    body: BodyDataStream,
    silence: Duration,
    alarm: Pin<Box<Sleep>>,
    was_silent: Arc<AtomicBool>,
}

impl Steady {
    /// A body whose pieces follow each other within this time. The flag says afterward whether
    /// they did not.
    pub fn new(body: BodyDataStream, silence: Duration, was_silent: Arc<AtomicBool>) -> Self {
        Self {
            body,
            silence,
            alarm: Box::pin(sleep(silence)),
            was_silent,
        }
    }
}

impl Stream for Steady {
    type Item = Result<Bytes, BoxError>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        if let Poll::Ready(piece) = self.body.poll_next_unpin(context) {
            let next = Instant::now() + self.silence;
            self.alarm.as_mut().reset(next);
            return Poll::Ready(piece.map(|piece| piece.map_err(Into::into)));
        }
        if self.alarm.as_mut().poll(context).is_pending() {
            return Poll::Pending;
        }
        self.was_silent.store(true, Ordering::Relaxed);
        Poll::Ready(Some(Err("no byte for too long".into())))
    }
}
