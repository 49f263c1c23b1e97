//! The record of a job.

use std::fmt;
use std::str::FromStr;

use serde::{Serialize, Serializer};
use uuid::Uuid;

use super::access::Owner;
use super::gates::Gates;
use super::lease::{Token, WorkerId};
use super::metadata::Metadata;
use super::progress::Event;
use super::state::State;
use super::timestamp::Timestamp;
use super::webhook::Webhook;
use unwrapd_api::{Failure, InputFile, Kind, OutputFile, Progress, Verdict};

/// Id of a job; ids sort by creation time (UUID version 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct JobId(Uuid);

impl JobId {
    /// Creates an id later than every id that this process created before.
    pub fn fresh() -> Self {
        Self(Uuid::now_v7())
    }

    /// Returns the time of creation by the clock of the creating process.
    pub fn made(self) -> Timestamp {
        let (seconds, nanos) = self.0.get_timestamp().map_or((0, 0), |time| time.to_unix());
        Timestamp(seconds as i64 * 1000 + i64::from(nanos) / 1_000_000)
    }
}

impl fmt::Display for JobId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for JobId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self)
    }
}

impl Serialize for JobId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Complete record of a job.
#[derive(Clone, Debug)]
pub struct Job {
    /// Id of the job.
    pub id: JobId,
    /// Owner of the job.
    pub owner: Owner,
    /// Kind of the computation.
    pub kind: Kind,
    /// Current state.
    pub state: State,
    /// Options of its kind, complete with defaults.
    pub options: serde_json::Value,
    /// Input files: the mesh, then the files it references.
    pub input: Vec<InputFile>,
    /// Output files, the main result first; empty until it succeeds.
    pub output: Vec<OutputFile>,
    /// Pictures of the result that were drawn after its end.
    pub drawn: Vec<OutputFile>,
    /// Verdict on the result; empty until it succeeds.
    pub verdict: Verdict,
    /// Number of the current attempt; 0 before the first.
    pub attempt: u32,
    /// Digest of the request: jobs with equal digests have equal inputs, kinds and options.
    pub digest: String,
    /// Priority: of an owner's waiting jobs, those with a higher one start first.
    pub priority: i32,
    /// The client's `traceparent` (W3C Trace Context), repeated in logs.
    pub trace: Option<String>,
    /// Notes of the client.
    pub metadata: Metadata,
    /// Gates that the result has to pass.
    pub accept: Option<Gates>,
    /// Webhook that is told of the end.
    pub webhook: Option<Webhook>,
    /// Fencing token of the current or last holder; reports of former holders are rejected.
    pub token: Token,
    /// Worker that holds the job.
    pub worker: Option<WorkerId>,
    /// End of that worker's lease, by the clock of the store.
    pub lease: Option<Timestamp>,
    /// Earliest time of the next start.
    pub due: Timestamp,
    /// Number of attempts whose computation was killed.
    pub lost: u32,
    /// Number of attempts lost with their workers since a client last queued the job.
    pub interrupted: u32,
    /// Set if it has been told to stop.
    pub cancel: bool,
    /// Set if it has been told to end early with its current map.
    pub finish_early: bool,
    /// Set if it belongs to a waiting request and is of no use without it.
    pub ephemeral: bool,
    /// Number of its latest event.
    pub seq: u64,
    /// Progress of the current attempt.
    pub progress: Progress,
    /// Cause of failure.
    pub failure: Option<Failure>,
    /// Time of acceptance.
    pub created: Timestamp,
    /// Start of the current or last attempt.
    pub started: Option<Timestamp>,
    /// Time at which it reached its final state.
    pub finished: Option<Timestamp>,
}

impl Job {
    /// Creates a queued job of the anonymous owner, without files.
    pub fn queued(id: JobId, kind: Kind, options: serde_json::Value) -> Self {
        Self {
            id,
            owner: Owner::anonymous(),
            kind,
            state: State::Queued,
            options,
            input: Vec::new(),
            output: Vec::new(),
            drawn: Vec::new(),
            verdict: Verdict::default(),
            attempt: 0,
            digest: String::new(),
            priority: 0,
            trace: None,
            metadata: Metadata::default(),
            accept: None,
            webhook: None,
            token: 0,
            worker: None,
            lease: None,
            due: Timestamp::now(),
            lost: 0,
            interrupted: 0,
            cancel: false,
            finish_early: false,
            ephemeral: false,
            seq: 1,
            progress: Progress::default(),
            failure: None,
            created: Timestamp::now(),
            started: None,
            finished: None,
        }
    }

    /// Returns the current state as an event.
    pub fn event(&self) -> Event {
        let until = self.finished.unwrap_or_else(Timestamp::now);
        Event {
            seq: self.seq,
            state: self.state,
            progress: self.progress,
            elapsed_ms: self.started.map_or(0, |started| until.since(started)),
        }
    }

    /// Returns whether the result meets the gates; `None` without gates, before the end, and for a cancelled job.
    pub fn accepted(&self) -> Option<bool> {
        let gates = self.accept.as_ref()?;
        let end = self.finished?;
        let seconds = self.started.map_or(0, |started| end.since(started)) as f64 / 1000.0;
        match self.state {
            State::Succeeded => Some(gates.accept(&self.verdict.quality, seconds)),
            State::Failed => Some(false),
            _ => None,
        }
    }

    /// Returns the bytes of its stored files; 0 for a cancelled job.
    pub fn stored_bytes(&self) -> u64 {
        if self.state == State::Cancelled {
            return 0;
        }
        let input = self.input.iter().map(|file| file.bytes);
        let made = self.output.iter().chain(&self.drawn);
        input.chain(made.map(|file| file.bytes)).sum()
    }

    /// Returns the output file with this role.
    pub fn output(&self, role: &str) -> Option<&OutputFile> {
        self.output.iter().find(|file| file.role == role)
    }
}
