//! Stages and progress of a computation.

use serde::{Deserialize, Serialize};

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
