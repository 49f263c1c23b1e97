//! A session as the server has it: a process, its pipes, and who listens.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use serde_json::Value;
use tokio::process::{ChildStdin, ChildStdout};
use tokio::sync::{broadcast, mpsc, watch};
use tokio::time::Instant;
use tokio_util::bytes::Bytes;
use tokio_util::sync::CancellationToken;

use super::pipe;
use crate::jobs::access::Owner;
use crate::jobs::{JobId, Scratch};
use unwrapd_api::pipe::{BAKE, BAKED, FAILED, FRAME, MESSAGE, REPLY};
use unwrapd_api::{Failure, InputFile, Kind};

/// Replies that a client may be behind.
const MOST_REPLIES: usize = 4096;

/// Why a session is over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// A client wanted that.
    Closed,
    /// Nobody said anything for a time.
    Expired,
    /// The service stops.
    Stopping,
    /// The computation failed.
    Failed(Failure),
}

/// A session.
pub struct Session {
    /// Names it.
    pub id: JobId,
    /// Whose it is.
    pub owner: Owner,
    /// What a job would do.
    pub kind: Kind,
    /// The options of the job, complete.
    pub options: Value,
    /// The files that it was made of, the mesh first.
    pub input: Vec<InputFile>,
    /// The mesh, as the protocol has it.
    pub mesh: Bytes,
    pub(super) folder: Scratch,
    stdin: tokio::sync::Mutex<ChildStdin>,
    frames: watch::Sender<Bytes>,
    replies: broadcast::Sender<Bytes>,
    heard: Mutex<Instant>,
    /// What the child says of starts that it was asked for.
    baked: mpsc::Sender<Result<Vec<Value>, Failure>>,
    pub(super) bakes: tokio::sync::Mutex<mpsc::Receiver<Result<Vec<Value>, Failure>>>,
    end: CancellationToken,
    why: OnceLock<End>,
}

/// What a session is made of.
pub(super) struct Parts {
    pub id: JobId,
    pub owner: Owner,
    pub kind: Kind,
    pub options: Value,
    pub input: Vec<InputFile>,
    pub folder: Scratch,
    pub mesh: Bytes,
    pub stdin: ChildStdin,
}

impl Session {
    pub(super) fn new(parts: Parts) -> Self {
        let (baked, bakes) = mpsc::channel(1);
        Self {
            id: parts.id,
            owner: parts.owner,
            kind: parts.kind,
            options: parts.options,
            input: parts.input,
            mesh: parts.mesh,
            folder: parts.folder,
            stdin: parts.stdin.into(),
            frames: watch::Sender::new(Bytes::new()),
            replies: broadcast::Sender::new(MOST_REPLIES),
            heard: Mutex::new(Instant::now()),
            baked,
            bakes: bakes.into(),
            end: CancellationToken::new(),
            why: OnceLock::new(),
        }
    }

    /// Passes a client's message on. It waits where the child has not read those before.
    ///
    /// # Errors
    /// If the child is gone.
    pub async fn say(&self, message: &[u8]) -> std::io::Result<()> {
        *lock(&self.heard) = Instant::now();
        pipe::send(&mut *self.stdin.lock().await, MESSAGE, message).await
    }

    pub(super) async fn ask_to_bake(&self) -> std::io::Result<()> {
        *lock(&self.heard) = Instant::now();
        pipe::send(&mut *self.stdin.lock().await, BAKE, &[]).await
    }

    /// The latest frame, and each after it that is still the latest when it is looked at. Empty before the first.
    pub fn frames(&self) -> watch::Receiver<Bytes> {
        self.frames.subscribe()
    }

    /// All replies from now on.
    pub fn replies(&self) -> broadcast::Receiver<Bytes> {
        self.replies.subscribe()
    }

    /// Clients that listen.
    pub fn n_clients(&self) -> usize {
        self.replies.receiver_count()
    }

    /// Seconds since a client said something.
    pub fn idle(&self) -> Duration {
        lock(&self.heard).elapsed()
    }

    /// Ends it, unless it has ended.
    pub fn close(&self, why: End) {
        self.why.get_or_init(|| why);
        self.end.cancel();
    }

    /// Why it is over, when it is.
    pub async fn ended(&self) -> End {
        self.end.cancelled().await;
        self.why.get().cloned().unwrap_or(End::Closed)
    }

    /// Passes on what the child says until it says no more; then why.
    pub(super) async fn relay(&self, stdout: &mut ChildStdout) -> Option<Failure> {
        while let Ok((tag, bytes)) = pipe::receive(stdout).await {
            match tag {
                FRAME => {
                    self.frames.send_replace(bytes);
                }
                REPLY => {
                    // Without clients nobody listens.
                    let _ = self.replies.send(bytes);
                }
                BAKED => {
                    let said = serde_json::from_slice::<Outcome>(&bytes);
                    let said = said.map_err(|e| Failure::new("internal_error", e.to_string()));
                    let _ = self.baked.try_send(said.and_then(Outcome::into_result));
                }
                FAILED => return serde_json::from_slice(&bytes).ok(),
                _ => {}
            }
        }
        None
    }

    /// Returns when nobody has said anything for so long.
    pub(super) async fn expired(&self, idle: Duration) {
        loop {
            let until = *lock(&self.heard) + idle;
            if until <= Instant::now() {
                return;
            }
            tokio::time::sleep_until(until).await;
        }
    }
}

/// A `Result` as JSON has it.
#[derive(serde::Deserialize)]
enum Outcome {
    Ok(Vec<Value>),
    Err(Failure),
}

impl Outcome {
    fn into_result(self) -> Result<Vec<Value>, Failure> {
        match self {
            Self::Ok(handles) => Ok(handles),
            Self::Err(failure) => Err(failure),
        }
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
