//! Progress and events of a job.

use serde::Serialize;

use super::state::State;
use unwrapd_api::Progress;

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
