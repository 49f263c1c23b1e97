//! Soft handles: handles with a weight, which come as near to their targets as the energy lets them.

use super::problem_error::ProblemError;
use unwrapd_method::energy::{Positional, Row, Term};

/// The pull of handles with weights:
///
/// ```text
/// Σ wᵢ ‖Cᵢx − tᵢ‖²
/// ```
/// where the weights of a handle's rows sum to the weight that its user gave. Minimum 0, at the targets. Unit: a
/// weight times a squared length. Domain: everywhere. From: Schüller et al. 2013, equation 1, with a weight for each
/// constraint. Tests: `lines::soft_handles_balance_the_energy`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SoftPull {
    rows: Vec<Row>,
    weights: Vec<f64>,
    /// Coordinates one after another.
    targets: Vec<f64>,
}

impl SoftPull {
    /// Returns whether nothing is pulled.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Iterates over the vertices that are pulled, some of them several times.
    pub(super) fn vertices(&self) -> impl Iterator<Item = u32> {
        self.rows.iter().flatten().map(|&(v, _)| v)
    }

    /// Adds the pull of one handle, which is shared equally among the points that it holds.
    pub(super) fn pull<const D: usize>(&mut self, held: &[(Row, [f64; D])], weight: f64) {
        for (row, target) in held {
            self.rows.push(row.clone());
            self.weights.push(weight / held.len() as f64);
            self.targets.extend(target);
        }
    }

    /// Returns the targets, coordinates one after another.
    pub(super) fn targets(&self) -> &[f64] {
        &self.targets
    }

    /// Returns the same pull toward other targets.
    pub(super) fn toward(&self, targets: Vec<f64>) -> Self {
        Self {
            targets,
            ..self.clone()
        }
    }

    /// Returns the pull as a term of an objective; `None` if nothing is pulled.
    pub(super) fn term(&self, dim: usize) -> Option<Box<dyn Term>> {
        if self.is_empty() {
            return None;
        }
        // Scale rows and targets by the root of the weight: squared distances are then weighted.
        let scaled = |(row, weight): (&Row, &f64)| -> Row {
            row.iter().map(|&(v, w)| (v, weight.sqrt() * w)).collect()
        };
        let targets = self.targets.chunks_exact(dim).zip(&self.weights);
        Some(Box::new(Positional {
            dim,
            rows: self.rows.iter().zip(&self.weights).map(scaled).collect(),
            targets: targets
                .flat_map(|(target, weight)| target.iter().map(|t| weight.sqrt() * t))
                .collect(),
            alpha: 1.0,
        }))
    }
}

/// Checks the weight of a soft handle.
pub(super) fn check_weight(weight: f64) -> Result<(), ProblemError> {
    if weight > 0.0 && weight.is_finite() {
        return Ok(());
    }
    let (name, range) = ("weight", "a positive number");
    Err(ProblemError::BadParameter { name, range })
}
