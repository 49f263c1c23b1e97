//! Bodies with a minimum speed.

use std::pin::Pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::BoxError;
use axum::body::{BodyDataStream, Bytes};
use futures_util::{Stream, StreamExt};
use tokio::time::{Instant, Sleep, sleep};

/// Reason for giving up a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tardy {
    /// No chunk arrived within the timeout.
    Silent,
    /// The chunks are too small.
    Slow,
}

/// Minimum speed of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tempo {
    /// Timeout between two chunks.
    pub silence: Duration,
    /// Minimum rate in bytes per second, on average over each period of `silence` spent waiting for chunks. The first
    /// period is the grace of a body that starts slowly.
    pub rate: u64,
}

/// A body that fails when it pauses for too long, or is too slow.
pub(super) struct Steady {
    body: BodyDataStream,
    tempo: Tempo,
    alarm: Pin<Box<Sleep>>,
    /// Start of waiting for the next chunk. While this process is busy with the last one, the client is not slow.
    waits: Option<Instant>,
    waited: Duration,
    /// Bytes received in the time waited.
    came: u64,
    tardy: Arc<OnceLock<Tardy>>,
}

impl Steady {
    /// Creates a body with this minimum speed; `tardy` is set if it fails.
    pub fn new(body: BodyDataStream, tempo: Tempo, tardy: Arc<OnceLock<Tardy>>) -> Self {
        Self {
            body,
            tempo,
            alarm: Box::pin(sleep(tempo.silence)),
            waits: None,
            waited: Duration::ZERO,
            came: 0,
            tardy,
        }
    }

    /// Counts a chunk. Returns whether the body was too slow for a whole period.
    fn is_slow_with(&mut self, piece: &Bytes) -> bool {
        self.waited += self
            .waits
            .take()
            .map_or(Duration::ZERO, |since| since.elapsed());
        self.came += piece.len() as u64;
        if self.waited < self.tempo.silence {
            return false;
        }
        let least = self.tempo.rate as f64 * self.waited.as_secs_f64();
        let is_slow = (self.came as f64) < least;
        (self.waited, self.came) = (Duration::ZERO, 0);
        is_slow
    }

    fn end(&self, tardy: Tardy) -> Poll<Option<Result<Bytes, BoxError>>> {
        let _ = self.tardy.set(tardy);
        Poll::Ready(Some(Err("the body comes too slowly".into())))
    }
}

impl Stream for Steady {
    type Item = Result<Bytes, BoxError>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        if let Poll::Ready(piece) = self.body.poll_next_unpin(context) {
            if let Some(Ok(piece)) = &piece
                && self.is_slow_with(piece)
            {
                return self.end(Tardy::Slow);
            }
            let next = Instant::now() + self.tempo.silence;
            self.alarm.as_mut().reset(next);
            return Poll::Ready(piece.map(|piece| piece.map_err(Into::into)));
        }
        self.waits.get_or_insert_with(Instant::now);
        if self.alarm.as_mut().poll(context).is_pending() {
            return Poll::Pending;
        }
        self.end(Tardy::Silent)
    }
}
