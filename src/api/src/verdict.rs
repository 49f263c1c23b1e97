//! What is known of a result beside its files.

use serde::{Deserialize, Serialize};

use crate::Warning;

/// What is known of a result beside its files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Verdict {
    /// What it is worth; `certified` is whether everything that was asked for is proven on the bytes written.
    #[serde(flatten)]
    pub worth: Worth,
    /// Whether the distortion keeps the bound that was asked for; none where there is no bound.
    pub within_bound: Option<bool>,
    /// What users should know of the input, of the work and of the result.
    pub warnings: Vec<Warning>,
    /// What computed it; empty in records of earlier versions of the program.
    pub engine: String,
}

/// What a result is worth, as far as its kind says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Worth {
    /// Whether everything requested is proven.
    pub certified: Option<bool>,
    /// Charts of all atlases.
    pub charts: Option<u64>,
    /// Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4.
    pub distortion: Option<f64>,
    /// 99th percentile of the stretch of the worst atlas; an isometry has 1.
    pub stretch: Option<f64>,
}

impl Worth {
    /// That of a result of which nothing is known but whether it is proven.
    pub fn proven(certified: bool) -> Self {
        Self {
            certified: Some(certified),
            ..Self::default()
        }
    }
}
