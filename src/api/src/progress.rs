//! Stages and progress of a computation.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io::ErrorKind;

/// The stages of a job, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// The file is being read.
    Read,
    /// Seams are being chosen.
    Cut,
    /// Charts are being mapped to the plane.
    Map,
    /// Handles are being pulled to their targets.
    Deform,
    /// Charts are being packed.
    Pack,
    /// Textures are being resampled.
    Bake,
    /// The document is being written.
    Write,
    /// The written bytes are being read again and judged.
    Judge,
}

impl Stage {
    /// Returns the name used in JSON.
    pub fn word(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Cut => "cut",
            Self::Map => "map",
            Self::Deform => "deform",
            Self::Pack => "pack",
            Self::Bake => "bake",
            Self::Write => "write",
            Self::Judge => "judge",
        }
    }

    /// Returns whether an early end shortens the stage.
    pub fn can_end_early(self) -> bool {
        matches!(self, Self::Cut | Self::Map | Self::Deform | Self::Pack)
    }
}

/// Progress within a job. Numbers that a stage does not have are left as they were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(default)]
pub struct Progress {
    /// Current stage, or the last one before a bad end; null before the start and after success.
    pub stage: Option<Stage>,
    /// Share of the work that is done, from 0 to 1. It never falls.
    #[cfg_attr(feature = "schema", schema(minimum = 0, maximum = 1))]
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
    /// Replaces this by a newer report, but never lowers the fraction, even over a retry.
    pub fn advance(&mut self, newer: Self) {
        let fraction = self.fraction.max(newer.fraction.clamp(0.0, 1.0));
        *self = Self { fraction, ..newer };
    }
}

// Verdicts on results.

/// Verdict on a result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Verdict {
    /// Quality figures; `certified` states whether everything requested is proven on the bytes written.
    #[serde(flatten)]
    pub quality: Quality,
    /// Outcome of the requested bound on distortion: true if it is kept, `None` without a bound.
    pub within_bound: Option<bool>,
    /// Warnings about the input, the work and the result.
    pub warnings: Vec<Warning>,
    /// Checksum of the program that computed it; empty in records of earlier versions of the program.
    pub engine: String,
}

/// Quality figures of a result, as far as its kind reports them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Quality {
    /// True if everything requested is proven; `None` for kinds that prove nothing.
    pub certified: Option<bool>,
    /// Number of charts of all atlases.
    pub charts: Option<u64>,
    /// Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4.
    pub distortion: Option<f64>,
    /// 99th percentile of the stretch of the worst atlas; an isometry has 1.
    pub stretch: Option<f64>,
}

impl Quality {
    /// Returns the figures of a result for which only this is known.
    pub fn proven(certified: bool) -> Self {
        Self {
            certified: Some(certified),
            ..Self::default()
        }
    }
}

// Failures of computations.

/// Cause of a failed job: a stable code and one sentence for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// Stable code in snake_case: one of the pipeline's, or `worker_lost`, `crashed`, `out_of_memory`, `timed_out`.
    pub code: String,
    /// Description in one line.
    pub detail: String,
}

impl Failure {
    /// Creates a failure from its code and its description.
    pub fn new(code: &str, detail: impl Into<String>) -> Self {
        Self {
            code: code.to_owned(),
            detail: detail.into(),
        }
    }
}

/// Converts the error of a folder of a computation, or of its process.
impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        let code = match error.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "storage_full",
            _ => "internal_error",
        };
        Self::new(code, error.to_string())
    }
}

// Warnings about files and results.

/// Something that users should know of a file that was read or written, and that is no error.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Warning {
    /// Stable snake_case word.
    pub code: Cow<'static, str>,
    /// Explanation and advice, in one or two sentences.
    pub message: String,
}

impl Warning {
    /// Creates a warning from its code and its message.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code: Cow::Borrowed(code),
            message: message.into(),
        }
    }
}
