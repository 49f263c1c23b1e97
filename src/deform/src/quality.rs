//! Quality of a map, independent of its origin.

use serde::{Deserialize, Serialize};

use super::normalized::Frame;
use super::problem::Problem;
use super::units::Units;
use unwrapd_method::barrier::Barrier;
use unwrapd_method::energy::{Positional, Term};
use unwrapd_method::solver::Handles;

/// Quality of a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = Worth))]
pub struct MapQuality {
    /// The deformation energy, without the barrier, in the `units` of the problem.
    pub energy: f64,
    /// The barrier's share, β included.
    pub barrier: f64,
    /// The sum of the squared distances of the handles from their targets, in the unit of the mesh.
    pub residual: f64,
    /// Elements whose determinant is not positive.
    pub inverted: usize,
    /// The smallest determinant over its value at rest.
    pub smallest: f64,
}

impl MapQuality {
    /// Converts the worth of a normalized map: distances in the caller's unit.
    pub(super) fn restored(self, frame: &Frame) -> Self {
        Self {
            residual: frame.squared(self.residual),
            ..self
        }
    }
}

impl Problem {
    /// Measures a map, whatever its origin.
    pub fn quality(&self, x: &[f64]) -> MapQuality {
        match self.units {
            Units::Given => self.quality_as_given(x),
            Units::Normalized => {
                let (inner, frame) = self.normalized();
                inner.quality_as_given(&frame.inward(x)).restored(&frame)
            }
        }
    }

    pub(super) fn quality_as_given(&self, x: &[f64]) -> MapQuality {
        let terms = |barrier| self.body.terms(&self.energy, barrier, None);
        let unmodified = terms(Barrier::NONE).unwrap_or_default();
        let guarded = terms(self.barrier).unwrap_or_default();
        let now = self.body.determinants_at(x);
        let ratios = now
            .iter()
            .zip(self.body.determinants())
            .map(|(now, rest)| now / rest);
        MapQuality {
            energy: unmodified.iter().map(|term| term.value(x)).sum(),
            barrier: (guarded.iter().map(|term| term.barrier(x)))
                .chain(self.boundary_term().map(|term| term.value(x)))
                .sum(),
            residual: self
                .stations
                .last()
                .map_or(0.0, |last| distance_squared(last, self.body.dim(), x)),
            inverted: now.iter().filter(|&&d| d <= 0.0).count(),
            smallest: ratios.fold(f64::INFINITY, f64::min),
        }
    }
}

fn distance_squared(handles: &Handles, dim: usize, x: &[f64]) -> f64 {
    let held = handles.vertices.iter();
    let places = held.flat_map(|&v| &x[dim * v as usize..dim * (v as usize + 1)]);
    let points = Positional {
        dim,
        rows: handles.points.clone(),
        targets: Vec::new(),
        alpha: 0.0,
    };
    let held: f64 = places
        .zip(&handles.targets)
        .map(|(x, t)| (x - t) * (x - t))
        .sum();
    held + points.residual(x, &handles.point_targets)
}
