//! How far a job is, as its child says it and as clients see it.

use serde::Serialize;

use super::state::State;
use unwrapd_api::Progress;

/// How far an attempt is, as its worker says it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Saying {
    /// Number of its latest event.
    pub seq: u64,
    /// How far it is.
    pub progress: Progress,
    /// Processor time that it has used.
    pub cpu_ms: u64,
}

/// One state of a job in its sequence. Events are snapshots: one that was missed is not needed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Event {
    /// Rises with every event of a job, with gaps.
    pub seq: u64,
    /// Where the job stands.
    pub state: State,
    /// How far it is.
    #[serde(flatten)]
    pub progress: Progress,
    /// Milliseconds since the present attempt started.
    pub elapsed_ms: u64,
}

/// Numbers set aside for the events of one attempt.
const EVENTS_PER_ATTEMPT: u64 = 1_000_000;

/// The first number of the next attempt: above all that a lost attempt may have sent without storing it.
pub fn next_attempt_seq(seq: u64) -> u64 {
    (seq / EVENTS_PER_ATTEMPT + 1) * EVENTS_PER_ATTEMPT
}
