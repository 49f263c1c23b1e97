//! The record of a job: its id, its state and progress, and the lease of its worker.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use serde::{Deserialize, Serialize, Serializer};
use uuid::Uuid;

use super::access::Owner;
use super::handling::{Gates, Metadata, Webhook};
use super::timestamp::Timestamp;
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

    /// Returns whether all of these words, in lower case, are parts of the texts that a person knows the job by: the name of
    /// its input, the texts `name` and `path` of its metadata, and its tags, which are members that are `true`.
    pub fn is_found_by(&self, words: &[String]) -> bool {
        if words.is_empty() {
            return true;
        }
        let filename = self.input.first().map(|file| file.name.as_str());
        let texts = filename.into_iter().chain(self.metadata.texts());
        let texts: Vec<String> = texts.map(str::to_lowercase).collect();
        let is_found = |word: &String| texts.iter().any(|text| text.contains(word));
        words.iter().all(is_found)
    }

    /// Returns the output file with this role.
    pub fn output(&self, role: &str) -> Option<&OutputFile> {
        self.output.iter().find(|file| file.role == role)
    }
}

// States of jobs.

/// State of a job. The last three are final.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// Stored and waiting for its turn.
    Queued,
    /// A compute child is working on it.
    Running,
    /// Done; result and report can be fetched.
    Succeeded,
    /// Ended with a cause, found in `error`.
    Failed,
    /// Ended by request.
    Cancelled,
}

impl State {
    /// All states, in the order of a job's life.
    pub const ALL: [Self; 5] = [
        Self::Queued,
        Self::Running,
        Self::Succeeded,
        Self::Failed,
        Self::Cancelled,
    ];

    /// Returns whether the job has ended. A failed job can still be retried.
    pub fn is_final(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }

    /// Returns the name used in JSON and in the store.
    pub fn word(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
        }
    }
}

// Progress and events of a job.

/// Progress report of an attempt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProgressReport {
    /// Number of its latest event.
    pub seq: u64,
    /// Progress of the attempt.
    pub progress: Progress,
    /// Processor time used, in milliseconds.
    pub cpu_ms: u64,
}

/// One state of a job in its sequence. Events are snapshots: one that was missed is not needed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Event {
    /// Rises with every event of a job, with gaps.
    pub seq: u64,
    /// State of the job.
    pub state: State,
    /// Progress of the attempt.
    #[serde(flatten)]
    pub progress: Progress,
    /// Milliseconds since the present attempt started.
    pub elapsed_ms: u64,
}

/// Event numbers reserved for each attempt. A child reports at most 40 times per second within a stage, so an attempt
/// of 600 s, the default limit, sends about 24,000 events at most.
const EVENTS_PER_ATTEMPT: u64 = 1_000_000;

/// Returns the first event number of the next attempt. It is above all numbers that a lost attempt may have sent
/// without recording them.
pub fn next_attempt_seq(seq: u64) -> u64 {
    (seq / EVENTS_PER_ATTEMPT + 1) * EVENTS_PER_ATTEMPT
}

// Leases of workers on jobs, and the rules for retries.

/// Id of one run of a worker process. It does not name a host, which may run several or come back as another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkerId(Uuid);

impl WorkerId {
    /// Creates an id that no worker had before.
    pub fn fresh() -> Self {
        Self(Uuid::now_v7())
    }
}

impl fmt::Display for WorkerId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for WorkerId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self)
    }
}

/// Fencing token of a job's holder. It rises whenever the job changes hands, so a former holder is recognized by its
/// lower number.
pub type Token = u64;

/// Rules for losing and retrying jobs.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// Time for which a lease lasts without a heartbeat.
    pub lease: Duration,
    /// Maximum number of attempts whose computation is killed, as for lack of memory, before the job fails.
    pub attempts: u32,
    /// Maximum number of attempts lost with their workers before the job fails. Jobs rarely kill workers, so this is
    /// much larger than `attempts`; but a job that kills every worker must end.
    pub interruptions: u32,
    /// Pause after the first lost attempt; it doubles with each further one.
    pub pause: Duration,
}

/// Upper bound of the pause. Doubled from one second, the twentieth would otherwise take six days.
const LONGEST_PAUSE: Duration = Duration::from_mins(5);
/// Number of lost workers after which a job is suspected of killing them. From then on a worker computes it alone, so
/// that it takes no other job down with it. One loss is usually an accident, such as a restart; a higher number puts
/// more innocent jobs at risk.
pub const SUSPECT: u32 = 2;

impl Default for Rules {
    fn default() -> Self {
        Self {
            lease: Duration::from_secs(15),
            attempts: 3,
            interruptions: 20,
            pause: Duration::from_secs(1),
        }
    }
}

impl Rules {
    /// Returns the pause after `lost` lost attempts, at least one.
    pub(super) fn pause_after(&self, lost: u32) -> Duration {
        let doubled = 1 << lost.saturating_sub(1).min(16);
        self.pause.saturating_mul(doubled).min(LONGEST_PAUSE)
    }

    /// Returns the longest pause under these rules.
    pub fn longest_pause(&self) -> Duration {
        self.pause_after(self.attempts.max(self.interruptions))
    }
}
