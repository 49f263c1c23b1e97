//! Choice and parameters of a barrier.

use super::{AugmentedLog, InverseSpline, Log, NeoHookean, NoBarrier};
use crate::energy::Guard;

/// Barrier that is added to the energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum BarrierKind {
    /// The inverse spline of the paper. No element inverts, and elements of ordinary size do not feel it.
    #[default]
    #[serde(alias = "spline")]
    InverseSpline,
    /// The augmented logarithm.
    #[serde(alias = "auglog")]
    AugmentedLog,
    /// The logarithm.
    Log,
    /// The volume term of a neo-Hookean material.
    #[serde(alias = "neohookean")]
    NeoHookean,
    /// No barrier, for comparison. An energy that is finite everywhere may invert elements.
    None,
}

/// A barrier with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Barrier {
    /// Kind of barrier.
    pub kind: BarrierKind,
    /// β, the barrier's factor.
    pub beta: f64,
    /// s, the share of the rest size below which the inverse spline is nonzero.
    pub s: f64,
    /// ε, the size at which the barrier is infinite; see [`epsilon`](super::epsilon).
    pub epsilon: f64,
}

impl Barrier {
    /// No barrier.
    pub const NONE: Self = Self {
        kind: BarrierKind::None,
        beta: 0.0,
        s: 1.0,
        epsilon: 0.0,
    };

    /// Calls `action` with the guard of this kind.
    fn with<R>(&self, action: impl FnOnce(&dyn Guard) -> R) -> R {
        let &Self {
            kind,
            beta,
            s,
            epsilon,
        } = self;
        match kind {
            BarrierKind::InverseSpline => action(&InverseSpline { beta, s, epsilon }),
            BarrierKind::AugmentedLog => action(&AugmentedLog { beta, epsilon }),
            BarrierKind::Log => action(&Log { beta, epsilon }),
            BarrierKind::NeoHookean => action(&NeoHookean { beta, epsilon }),
            BarrierKind::None => action(&NoBarrier),
        }
    }
}

impl Guard for Barrier {
    fn floor(&self, rest_size: f64) -> f64 {
        self.with(|guard| guard.floor(rest_size))
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        self.with(|guard| guard.value(det, rest_size))
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        self.with(|guard| guard.derivatives(det, rest_size))
    }
}
