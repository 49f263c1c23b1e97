//! Registry of the sessions of this process.

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use serde_json::Value;
use tokio::process::{Child, ChildStderr, ChildStdout};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_util::bytes::Bytes;
use tokio_util::task::TaskTracker;

use super::session;
use super::session::{OpenSession, Parts, SessionEnd, lock};
use crate::jobs::access::{Owner, Visibility};
use crate::jobs::{self, JobId, Scratch, read_stderr};
use unwrapd_api::pipe::{FAILED, MESH};
use unwrapd_api::{Failure, InputFile, Kind, Limits, Pictures, TASK, Task, input_file, write_json};

/// Time for a child to read its input and become ready. A longer limit lets a hanging child keep its slot, a shorter
/// one refuses large inputs on slow machines.
const START_TIME: Duration = Duration::from_mins(2);

/// Limits of sessions.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Maximum number of sessions at a time.
    pub most: usize,
    /// Maximum number per owner. `None` stands for half of `most`, or for all of it without keys.
    pub most_of_owner: Option<usize>,
    /// Time without messages after which a session ends.
    pub idle: Duration,
}

impl Settings {
    /// Returns the maximum number of sessions of an owner.
    fn most_of(&self, owner: &Owner) -> usize {
        self.most_of_owner.unwrap_or(match owner.name() {
            Some(_) => self.most.div_ceil(2),
            None => self.most,
        })
    }
}

/// All sessions of this process.
pub struct Sessions {
    settings: Settings,
    jobs: jobs::Settings,
    slots: Arc<Semaphore>,
    slots_of_owners: Mutex<HashMap<Owner, Arc<Semaphore>>>,
    open: Mutex<BTreeMap<JobId, Arc<OpenSession>>>,
    tasks: TaskTracker,
}

/// Input of a new session.
pub struct NewSession {
    /// Owner of the session.
    pub owner: Owner,
    /// Kind of the job that it corresponds to.
    pub kind: Kind,
    /// Options of that job, complete.
    pub options: Value,
    /// Input files with their current paths: the mesh, then the files it references. They are moved away.
    pub files: Vec<(InputFile, PathBuf)>,
}

/// Reason why a session was not opened.
#[derive(Debug)]
pub enum Unopened {
    /// The maximum number of sessions is open.
    AllTaken,
    /// Its owner has the maximum number of sessions open.
    OwnTaken,
    /// The input or the options are invalid, or the service failed.
    Failed(Failure),
}

impl From<std::io::Error> for Unopened {
    fn from(error: std::io::Error) -> Self {
        Self::Failed(error.into())
    }
}

impl Sessions {
    /// Creates an empty registry. Children are started with the limits of jobs.
    pub fn new(settings: Settings, jobs: jobs::Settings) -> Self {
        Self {
            slots: Arc::new(Semaphore::new(settings.most)),
            slots_of_owners: Mutex::default(),
            open: Mutex::default(),
            tasks: TaskTracker::new(),
            settings,
            jobs,
        }
    }

    /// Returns the limits of sessions.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the number of open sessions.
    pub fn count(&self) -> usize {
        lock(&self.open).len()
    }

    /// Opens a session. When this returns, its child has read the input and is ready.
    pub async fn open(self: &Arc<Self>, opened: NewSession) -> Result<Arc<OpenSession>, Unopened> {
        // Reserve the slots of the session.
        let slots = self.slots(&opened.owner)?;
        let id = JobId::fresh();
        // Move the input to its folder, and start the child.
        let folder = Scratch::make(self.jobs.scratch.join(format!("session-{id}")))?;
        for (index, (_, path)) in opened.files.iter().enumerate() {
            tokio::fs::rename(path, folder.path().join(input_file(index))).await?;
        }
        write_json(folder.path(), TASK, &self.task(&opened))?;
        let mut child = jobs::spawn(&self.jobs.program, "session", folder.path())?;
        let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let (Some(stdin), Some(mut stdout), Some(stderr)) = pipes else {
            return Err(std::io::Error::other("a pipe of the child is missing").into());
        };
        tokio::spawn(log(id, stderr));
        // The mesh is the first thing that the child sends.
        let session = Arc::new(OpenSession::new(Parts {
            id,
            owner: opened.owner,
            mesh: mesh(&mut stdout).await.map_err(Unopened::Failed)?,
            kind: opened.kind,
            options: opened.options,
            input: opened.files.into_iter().map(|(file, _)| file).collect(),
            folder,
            stdin,
        }));
        lock(&self.open).insert(id, Arc::clone(&session));
        let supervised = Arc::clone(self).supervise(Arc::clone(&session), child, stdout, slots);
        self.tasks.spawn(supervised);
        tracing::info!(session = %id, kind = session.kind.word(), "opened");
        Ok(session)
    }

    /// Reserves a slot of all and a slot of the owner.
    fn slots(&self, owner: &Owner) -> Result<[OwnedSemaphorePermit; 2], Unopened> {
        let most = self.settings.most_of(owner);
        let of_owner = Arc::clone(
            (lock(&self.slots_of_owners).entry(owner.clone()))
                .or_insert_with(|| Arc::new(Semaphore::new(most))),
        );
        let all = Arc::clone(&self.slots).try_acquire_owned();
        Ok([
            all.map_err(|_| Unopened::AllTaken)?,
            of_owner
                .try_acquire_owned()
                .map_err(|_| Unopened::OwnTaken)?,
        ])
    }

    fn task(&self, opened: &NewSession) -> Task {
        let threads = self.jobs.threads(lock(&self.open).len() + 1);
        Task {
            kind: opened.kind,
            input: opened.files.iter().map(|(f, _)| f.name.clone()).collect(),
            options: opened.options.clone(),
            limits: Limits {
                triangles: Some(self.jobs.triangles),
                threads: Some(threads),
                seconds: None,
            },
            memory: self.jobs.memory,
            pictures: Pictures::LeftOut,
        }
    }

    /// Relays until the session ends, then kills its child.
    async fn supervise(
        self: Arc<Self>,
        session: Arc<OpenSession>,
        mut child: Child,
        mut stdout: ChildStdout,
        slots: [OwnedSemaphorePermit; 2],
    ) {
        tokio::select! {
            said = session.relay(&mut stdout) => {
                session.close(SessionEnd::Failed(said.unwrap_or_else(crashed)));
            }
            () = session.expired(self.settings.idle) => session.close(SessionEnd::Expired),
            _ = session.ended() => {}
        }
        lock(&self.open).remove(&session.id);
        if let Err(error) = child.kill().await {
            tracing::warn!(session = %session.id, %error, "child not ended");
        }
        let why = session.ended().await;
        tracing::info!(session = %session.id, ?why, "ended");
        drop(slots);
    }

    /// Returns the session with this id if it is visible.
    pub fn get(&self, visibility: &Visibility, id: JobId) -> Option<Arc<OpenSession>> {
        let session = lock(&self.open).get(&id).cloned();
        session.filter(|session| visibility.covers(&session.owner))
    }

    /// Returns the visible sessions in the order of opening.
    pub fn list(&self, visibility: &Visibility) -> Vec<Arc<OpenSession>> {
        let open = lock(&self.open);
        let within = open
            .values()
            .filter(|session| visibility.covers(&session.owner));
        within.cloned().collect()
    }

    /// Ends all sessions and waits until their children are gone.
    pub async fn stop(&self) {
        self.slots.close();
        for session in self.list(&Visibility::All) {
            session.close(SessionEnd::Stopping);
        }
        self.tasks.close();
        self.tasks.wait().await;
    }
}

/// Receives the mesh, which a child sends when it is ready.
async fn mesh(stdout: &mut ChildStdout) -> Result<Bytes, Failure> {
    match tokio::time::timeout(START_TIME, session::receive(stdout)).await {
        Ok(Ok((MESH, mesh))) => Ok(mesh),
        Ok(Ok((FAILED, failure))) => {
            Err(serde_json::from_slice(&failure).unwrap_or_else(|_| crashed()))
        }
        Ok(_) => Err(crashed()),
        Err(_) => {
            let detail = "the input was not read in time";
            Err(Failure::new("timed_out", detail))
        }
    }
}

/// Logs the standard error of a child.
async fn log(session: JobId, stderr: ChildStderr) {
    let said = read_stderr(stderr).await;
    if !said.is_empty() {
        tracing::warn!(%session, said, "session child");
    }
}

fn crashed() -> Failure {
    Failure::new(
        "crashed",
        "the computation ended, which is a bug in the service",
    )
}
