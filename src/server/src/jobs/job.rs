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

/// Names a job; ids sort by the time of their making (UUID version 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct JobId(Uuid);

impl JobId {
    /// A fresh id, later than every id this process made before.
    pub fn fresh() -> Self {
        Self(Uuid::now_v7())
    }

    /// When it was made, by the clock of the process that did.
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

/// Everything that is known of a job.
#[derive(Clone, Debug)]
pub struct Job {
    /// Names it.
    pub id: JobId,
    /// Whose it is.
    pub owner: Owner,
    /// What it does.
    pub kind: Kind,
    /// Where it stands.
    pub state: State,
    /// Options of its kind, complete with defaults.
    pub options: serde_json::Value,
    /// The mesh, then the files it references.
    pub input: Vec<InputFile>,
    /// What it made; empty until it succeeded. The main result is first.
    pub output: Vec<OutputFile>,
    /// Pictures that were drawn of that after its end.
    pub drawn: Vec<OutputFile>,
    /// What is known of that; empty until it succeeded.
    pub verdict: Verdict,
    /// How often it was started.
    pub attempt: u32,
    /// Names what was asked for: jobs with the same digest have equal inputs, kinds and options.
    pub digest: String,
    /// Of the waiting jobs of one owner, those of higher priority start first.
    pub priority: i32,
    /// The `traceparent` that the client sent (W3C Trace Context), which logs repeat.
    pub trace: Option<String>,
    /// What its client notes of it.
    pub metadata: Metadata,
    /// What its result has to be.
    pub accept: Option<Gates>,
    /// Where its end is told.
    pub webhook: Option<Webhook>,
    /// Names its present or last holder; fences off what former ones report.
    pub token: Token,
    /// Who has it.
    pub worker: Option<WorkerId>,
    /// When that worker must have given a sign of life, by the clock of the store.
    pub lease: Option<Timestamp>,
    /// When it may be started.
    pub due: Timestamp,
    /// How many attempts were ended from outside.
    pub lost: u32,
    /// Attempts that were lost with their workers since it was last queued by a client.
    pub interrupted: u32,
    /// Whether it shall stop.
    pub cancel: bool,
    /// Whether it shall end early with the map it has.
    pub finish_early: bool,
    /// Whether it belongs to a waiting call and is of no use without it.
    pub ephemeral: bool,
    /// Number of its latest event.
    pub seq: u64,
    /// How far it is.
    pub progress: Progress,
    /// Why it failed.
    pub failure: Option<Failure>,
    /// When it was accepted.
    pub created: Timestamp,
    /// When its present or last attempt started.
    pub started: Option<Timestamp>,
    /// When it reached its final state.
    pub finished: Option<Timestamp>,
}

impl Job {
    /// A job of the anonymous owner that waits and has no files yet.
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

    /// Its present state as an event.
    pub fn event(&self) -> Event {
        let until = self.finished.unwrap_or_else(Timestamp::now);
        Event {
            seq: self.seq,
            state: self.state,
            progress: self.progress,
            elapsed_ms: self.started.map_or(0, |started| until.since(started)),
        }
    }

    /// Whether it is as its client wants it; none if nothing is wanted, or before its end.
    pub fn accepted(&self) -> Option<bool> {
        let gates = self.accept.as_ref()?;
        let end = self.finished?;
        let seconds = self.started.map_or(0, |started| end.since(started)) as f64 / 1000.0;
        match self.state {
            State::Succeeded => Some(gates.accept(&self.verdict.worth, seconds)),
            State::Failed => Some(false),
            _ => None,
        }
    }

    /// Bytes of the files that are kept of it.
    pub fn stored_bytes(&self) -> u64 {
        if self.state == State::Cancelled {
            return 0;
        }
        let input = self.input.iter().map(|file| file.bytes);
        let made = self.output.iter().chain(&self.drawn);
        input.chain(made.map(|file| file.bytes)).sum()
    }

    /// The output found under a role.
    pub fn output(&self, role: &str) -> Option<&OutputFile> {
        self.output.iter().find(|file| file.role == role)
    }
}
