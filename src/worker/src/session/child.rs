//! The child process of a session.

use std::collections::BTreeSet;
use std::fs::File;
use std::os::fd::AsFd;
use std::path::Path;
use std::sync::mpsc::{Receiver, sync_channel};

use serde::Serialize;
use serde_json::Value;

use super::editing::Message;
use super::live_session::LiveSession;
use crate::attempt::contain;
use unwrapd_api::pipe::{self, BAKE, BAKED, FAILED, FRAME, MESH, REPLY};
use unwrapd_api::{Failure, START, TASK, Task, read_json, read_upload};
use unwrapd_pipeline::{Workers, in_pool, start_file};

/// Maximum number of queued messages. When the queue is full, the pipe fills up and the client waits. A longer queue
/// lets clients run further ahead of the solver, a shorter one stops them sooner.
const MOST_WAITING: usize = 1024;

/// A record from the server.
enum ServerRecord {
    Message(Result<Message, (u32, Failure)>),
    Bake,
}

/// Runs the session in `folder` until standard input ends, and returns the exit code of the process.
pub fn run(folder: &Path) -> u8 {
    // Bypass the line buffer of standard output: records are binary.
    let out = match std::io::stdout().as_fd().try_clone_to_owned() {
        Ok(out) => File::from(out),
        Err(_) => return 1,
    };
    let Err(failure) = session(folder, &out) else {
        return 0;
    };
    tell(&out, FAILED, &json(&failure));
    3
}

fn session(folder: &Path, out: &File) -> Result<(), Failure> {
    // Listen first, so that the child exits if its server is gone while it reads the input.
    let said = listen()?;
    let task: Task = read_json(folder, TASK)?;
    contain(task.memory)?;
    let workers = Workers {
        threads: task.limits.threads,
    };
    let served = in_pool(workers, move || {
        let upload = read_upload(folder, &task.input)?;
        let session = LiveSession::new(task.kind, &task.options, &upload, task.limits)?;
        serve(session, &said, folder, out);
        Ok(())
    });
    served.map_err(|error| Failure::new(error.code(), error.to_string()))?
}

/// Starts the thread that listens to the server. The process exits when standard input ends, because the server is
/// gone or closed the session.
fn listen() -> std::io::Result<Receiver<ServerRecord>> {
    let (say, said) = sync_channel(MOST_WAITING);
    std::thread::Builder::new().spawn(move || {
        let mut stdin = std::io::stdin().lock();
        while let Ok((tag, bytes)) = pipe::read(&mut stdin) {
            let heard = match tag {
                BAKE => ServerRecord::Bake,
                _ => ServerRecord::Message(Message::read(&bytes)),
            };
            if say.send(heard).is_err() {
                break;
            }
        }
        std::process::exit(0);
    })?;
    Ok(said)
}

/// Handles messages as they arrive, iterates while the map moves, and sends a frame after each iteration.
fn serve(mut session: LiveSession, said: &Receiver<ServerRecord>, folder: &Path, out: &File) {
    tell(out, MESH, &session.mesh());
    tell(out, FRAME, &session.frame());
    loop {
        let first = if session.is_moving() {
            None
        } else {
            match said.recv() {
                Ok(first) => Some(first),
                Err(_) => return,
            }
        };
        let batch: Vec<ServerRecord> = first.into_iter().chain(said.try_iter()).collect();
        handle(&mut session, batch, folder, out);
        session.step();
        tell(out, FRAME, &session.frame());
    }
}

/// Handles the records since the last iteration. Among moves of one handle with nothing but moves between them, only
/// the last one has an effect, so outdated positions do not delay a drag.
fn handle(session: &mut LiveSession, batch: Vec<ServerRecord>, folder: &Path, out: &File) {
    let is_late = superseded(&batch);
    for (said, is_late) in batch.into_iter().zip(is_late) {
        let reply = match said {
            ServerRecord::Bake => {
                tell(out, BAKED, &json(&bake(session, folder)));
                continue;
            }
            ServerRecord::Message(Ok(message)) if is_late => session.supersede(message.n),
            ServerRecord::Message(Ok(message)) => session.execute(&message),
            ServerRecord::Message(Err((n, error))) => session.refuse(n, error),
        };
        tell(out, REPLY, &json(&reply));
    }
}

/// Returns which records are moves superseded by a later one.
fn superseded(batch: &[ServerRecord]) -> Vec<bool> {
    let mut moved_later = BTreeSet::new();
    let mut late = vec![false; batch.len()];
    for (said, is_late) in batch.iter().zip(&mut late).rev() {
        match said {
            ServerRecord::Message(Ok(message)) => match message.moved() {
                Some(name) => *is_late = !moved_later.insert(name),
                None => moved_later.clear(),
            },
            _ => moved_later.clear(),
        }
    }
    late
}

/// Writes the map to the folder, if a job begins from it, and returns the handles of the job.
fn bake(session: &mut LiveSession, folder: &Path) -> Result<Vec<Value>, Failure> {
    let (handles, start) = session.baked();
    if let Some(start) = start {
        std::fs::write(folder.join(START), start_file(&start))?;
    }
    Ok(handles)
}

fn json(value: &impl Serialize) -> Vec<u8> {
    serde_json::to_vec(value).unwrap_or_default()
}

/// Sends a record. Exits if that fails, because nobody listens any more.
fn tell(mut out: &File, tag: u8, bytes: &[u8]) {
    if pipe::write(&mut out, tag, bytes).is_err() {
        std::process::exit(1);
    }
}
