//! Bodies that keep coming.

use std::pin::Pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::BoxError;
use axum::body::{BodyDataStream, Bytes};
use futures_util::{Stream, StreamExt};
use tokio::time::{Instant, Sleep, sleep};

/// Why a body was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tardy {
    /// There was no piece of it for too long.
    Silent,
    /// Its pieces are too small.
    Slow,
}

/// How fast a body has to come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tempo {
    /// Between two pieces.
    pub silence: Duration,
    /// Bytes in a second, on average over each time of `silence` that this process waits for pieces. The first such time is the
    /// grace of a body that begins slowly.
    pub rate: u64,
}

/// A body that fails when it is silent for too long, or too slow.
pub(super) struct Steady {
    body: BodyDataStream,
    tempo: Tempo,
    alarm: Pin<Box<Sleep>>,
    /// Since when the next piece is waited for. While this process is busy with the last one, its client is not slow.
    waits: Option<Instant>,
    waited: Duration,
    /// Bytes that came in the time waited.
    came: u64,
    tardy: Arc<OnceLock<Tardy>>,
}

impl Steady {
    /// A body of this tempo; `tardy` says afterward in which way it did not keep it.
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

    /// Counts a piece. Returns whether the body has come too slowly for a whole time.
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
