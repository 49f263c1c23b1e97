//! Verdicts on results.

use serde::{Deserialize, Serialize};

use crate::Warning;

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
