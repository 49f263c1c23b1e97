//! How far a job is, as its child says it and as clients see it.

use serde::{Deserialize, Serialize};

use super::state::State;
use unwrapd_pipeline::Stage;

/// Progress within a job. Numbers that a stage does not have are left as they were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(default)]
pub struct Progress {
    /// What is being done, or was being done at a bad end; null before the start and after success.
    pub stage: Option<Stage>,
    /// How much is done, from 0 to 1. It never falls.
    #[schema(minimum = 0, maximum = 1)]
    pub fraction: f64,
    /// Charts mapped so far. Those that are cut again count again once they are mapped.
    pub chart: u64,
    /// Charts known so far. With `cut` `auto` cuts add some, and some are joined.
    pub charts: u64,
    /// Iteration of the solver on the chart at hand.
    pub iteration: u64,
    /// Energy of the chart at hand; null before the first iteration, and where flat charts need none.
    pub energy: Option<f64>,
    /// Smallest face of the chart at hand, as a share of its rest area: positive means no flip. Null where `energy` is.
    pub smallest: Option<f64>,
}

impl Progress {
    /// Takes over a newer report; the fraction keeps its highest value, also over a repeated attempt.
    pub fn advance(&mut self, newer: Self) {
        let fraction = self.fraction.max(newer.fraction.clamp(0.0, 1.0));
        *self = Self { fraction, ..newer };
    }
}

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
