//! A session on the server's side: a process, its pipes, its listeners, and the job that it can become.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use serde_json::Value;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::process::{ChildStdin, ChildStdout};
use tokio::sync::{broadcast, mpsc, watch};
use tokio::time::Instant;
use tokio_util::bytes::Bytes;
use tokio_util::sync::CancellationToken;

use crate::jobs::access::Owner;
use crate::jobs::{Digest, Handling, JobId, Scratch, Submission};
use unwrapd_api::pipe::{BAKE, BAKED, FAILED, FRAME, MESSAGE, REPLY, head, length};
use unwrapd_api::{Failure, InputFile, Kind, START, input_file, sha256};

/// Number of replies that a client may lag behind before it is disconnected. A larger buffer takes more memory per
/// session, a smaller one disconnects slow clients sooner.
const MOST_REPLIES: usize = 4096;

/// Reason why a session ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SessionEnd {
    /// A client closed it.
    Closed,
    /// No client sent a message for the idle time.
    Expired,
    /// The service is stopping.
    Stopping,
    /// The computation failed.
    Failed(Failure),
}

/// A live session.
pub struct OpenSession {
    /// Id of the session.
    pub id: JobId,
    /// Owner of the session.
    pub owner: Owner,
    /// Kind of the job that it corresponds to.
    pub kind: Kind,
    /// Options of that job, complete.
    pub options: Value,
    /// Input files, the mesh first.
    pub input: Vec<InputFile>,
    /// The mesh in the format of the protocol.
    pub mesh: Bytes,
    pub(super) folder: Scratch,
    stdin: tokio::sync::Mutex<ChildStdin>,
    frames: watch::Sender<Bytes>,
    replies: broadcast::Sender<Bytes>,
    heard: Mutex<Instant>,
    /// Answers of the child to requests for a start file.
    baked: mpsc::Sender<Result<Vec<Value>, Failure>>,
    pub(super) bakes: tokio::sync::Mutex<mpsc::Receiver<Result<Vec<Value>, Failure>>>,
    end: CancellationToken,
    why: OnceLock<SessionEnd>,
}

/// Parts of a new session.
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

impl OpenSession {
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

    /// Passes a client's message to the child. Waits while the child has unread messages that fill the pipe.
    ///
    /// # Errors
    /// Fails if the child is gone.
    pub async fn say(&self, message: &[u8]) -> std::io::Result<()> {
        *lock(&self.heard) = Instant::now();
        send(&mut *self.stdin.lock().await, MESSAGE, message).await
    }

    pub(super) async fn ask_to_bake(&self) -> std::io::Result<()> {
        *lock(&self.heard) = Instant::now();
        send(&mut *self.stdin.lock().await, BAKE, &[]).await
    }

    /// Subscribes to frames. Each read returns the latest one; it is empty before the first.
    pub fn frames(&self) -> watch::Receiver<Bytes> {
        self.frames.subscribe()
    }

    /// Subscribes to replies from now on.
    pub fn replies(&self) -> broadcast::Receiver<Bytes> {
        self.replies.subscribe()
    }

    /// Returns the number of connected clients.
    pub fn n_clients(&self) -> usize {
        self.replies.receiver_count()
    }

    /// Returns the time since the last message of a client.
    pub fn idle(&self) -> Duration {
        lock(&self.heard).elapsed()
    }

    /// Ends the session for this reason, unless it has ended.
    pub fn close(&self, why: SessionEnd) {
        self.why.get_or_init(|| why);
        self.end.cancel();
    }

    /// Waits for the end of the session and returns the reason.
    pub async fn ended(&self) -> SessionEnd {
        self.end.cancelled().await;
        self.why.get().cloned().unwrap_or(SessionEnd::Closed)
    }

    /// Relays the child's records until its output ends. Returns the failure that it reports, if any.
    pub(super) async fn relay(&self, stdout: &mut ChildStdout) -> Option<Failure> {
        while let Ok((tag, bytes)) = receive(stdout).await {
            match tag {
                FRAME => {
                    self.frames.send_replace(bytes);
                }
                REPLY => {
                    // Sending fails without clients, and then nobody needs the reply.
                    let _ = self.replies.send(bytes);
                }
                BAKED => {
                    let said = serde_json::from_slice::<BakeOutcome>(&bytes);
                    let said = said.map_err(|e| Failure::new("internal_error", e.to_string()));
                    let _ = self.baked.try_send(said.and_then(BakeOutcome::into_result));
                }
                FAILED => return serde_json::from_slice(&bytes).ok(),
                _ => {}
            }
        }
        None
    }

    /// Waits until no message has arrived for the time `idle`.
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

/// A `Result` in JSON.
#[derive(serde::Deserialize)]
enum BakeOutcome {
    Ok(Vec<Value>),
    Err(Failure),
}

impl BakeOutcome {
    fn into_result(self) -> Result<Vec<Value>, Failure> {
        match self {
            Self::Ok(handles) => Ok(handles),
            Self::Err(failure) => Err(failure),
        }
    }
}

/// Locks a mutex, also after a panic of its last holder.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

// Conversion of sessions to jobs.

/// Job made from a session, and the folder with its files, which must be kept until they are moved.
pub struct Baked {
    /// Submission of the job.
    pub submission: Submission,
    /// Folder with its files.
    pub folder: Scratch,
}

impl OpenSession {
    /// Turns the present state of the session into a job: the same input and options, with the current handles, and
    /// the current map as its [start](START) unless the handles tell all. The session goes on.
    ///
    /// # Errors
    /// Fails if there is no handle, or a file cannot be written.
    pub async fn bake(&self) -> Result<Baked, Failure> {
        // Ask the child for its map and its handles, one request at a time: each writes the same file.
        let mut bakes = self.bakes.lock().await;
        self.ask_to_bake().await?;
        let said = tokio::select! {
            said = bakes.recv() => said,
            _ = self.ended() => None,
        };
        let Some(handles) = said.transpose()? else {
            return Err(Failure::new("session_not_found", "it has ended"));
        };
        if handles.is_empty() {
            return Err(Failure::new("no_handle", "nothing is pulled"));
        }
        // Link the input files into a folder of their own.
        let path = self
            .folder
            .path()
            .with_file_name(format!("baked-{}", JobId::fresh()));
        let folder = Scratch::make(path)?;
        let mut files = Vec::new();
        for (index, file) in self
            .input
            .iter()
            .filter(|file| file.name != START)
            .enumerate()
        {
            let place = folder.path().join(input_file(index));
            tokio::fs::hard_link(self.folder.path().join(input_file(index)), &place).await?;
            files.push((file.clone(), place));
        }
        // Add the current map, which the child has just written.
        if begins_from_map(self.kind) {
            let start = tokio::fs::read(self.folder.path().join(START)).await?;
            let place = folder.path().join(START);
            tokio::fs::write(&place, &start).await?;
            let file = InputFile {
                name: START.to_owned(),
                bytes: start.len() as u64,
                sha256: Some(sha256(&start)),
            };
            files.push((file, place));
        }
        // Describe the job.
        let options = with_handles(self.kind, self.options.clone(), handles);
        let submission = Submission {
            owner: self.owner.clone(),
            digest: Digest::of_job(self.kind, &options, files.iter().map(|(file, _)| file)),
            kind: self.kind,
            options,
            files,
            handling: Handling::default(),
            trace: None,
            reuse: false,
            key: None,
            ephemeral: false,
        };
        Ok(Baked { submission, folder })
    }
}

/// Returns the options of a job with these handles.
fn with_handles(kind: Kind, mut options: Value, handles: Vec<Value>) -> Value {
    let name = match kind {
        Kind::EditUv | Kind::TextureMap => "anchors",
        Kind::Repack => "islands",
        _ => "handles",
    };
    options[name] = Value::Array(handles);
    options
}

/// Returns whether a job of this kind begins from the map of a session. The islands of `repack` have their places in
/// its options.
fn begins_from_map(kind: Kind) -> bool {
    kind != Kind::Repack
}

// Asynchronous records on the pipe between server and child.

/// Writes a record.
async fn send(to: &mut (impl AsyncWrite + Unpin), tag: u8, bytes: &[u8]) -> std::io::Result<()> {
    to.write_all(&[&head(tag, bytes.len()), bytes].concat())
        .await
}

/// Reads a record: its tag and its bytes.
pub(super) async fn receive(from: &mut (impl AsyncRead + Unpin)) -> std::io::Result<(u8, Bytes)> {
    let mut head = [0; 5];
    from.read_exact(&mut head).await?;
    let mut bytes = vec![0; length(head)?];
    from.read_exact(&mut bytes).await?;
    Ok((head[0], bytes.into()))
}
