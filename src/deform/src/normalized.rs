//! Conversion of problems to the unit in which their numbers are meant.
//!
//! β, ε, tolerances and energies have the same meaning for a ring and a city if the mean element has size 1 and the
//! body lies around the origin. A problem is converted to this frame, solved, and converted back; the caller does not
//! notice.

use super::body::{Body, BodyElements};
use super::boundary_barrier::BoundaryBarrier;
use super::problem::{Problem, Units};
use super::soft::SoftPull;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use unwrapd_method::barrier::Barrier;
use unwrapd_method::energy::{Positional, RestShape, Term};
use unwrapd_method::solver::{Control, Handles, Iterate, Watch};

/// Position and scale of the normalized frame in the given coordinates.
pub(super) struct Frame {
    origin: Vec<f64>,
    unit: f64,
}

impl Frame {
    /// Computes the center of a body's box, and the unit in which its mean element has size 1.
    pub fn of(body: &Body) -> Self {
        let dim = body.dim();
        let mean = match &body.elements {
            BodyElements::Triangles { rest, .. } => mean_size(rest),
            BodyElements::Tetrahedra { rest, .. } => mean_size(rest),
        };
        let middle = |k: usize| {
            let places = body.rest.iter().skip(k).step_by(dim);
            let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
                (low.min(x), high.max(x))
            });
            0.5 * (low + high)
        };
        Self {
            origin: (0..dim).map(middle).collect(),
            unit: mean.powf(1.0 / dim as f64),
        }
    }

    pub fn unit(&self) -> f64 {
        self.unit
    }

    pub fn inward(&self, x: &[f64]) -> Vec<f64> {
        let origin = self.origin.iter().cycle();
        x.iter()
            .zip(origin)
            .map(|(x, o)| (x - o) / self.unit)
            .collect()
    }

    pub fn outward(&self, x: &[f64]) -> Vec<f64> {
        self.places(x).collect()
    }

    fn places<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let origin = self.origin.iter().cycle();
        x.iter().zip(origin).map(|(x, o)| o + x * self.unit)
    }

    /// Converts the targets of handles to normalized positions.
    pub fn handles(&self, handles: &Handles) -> Handles {
        Handles {
            targets: self.inward(&handles.targets),
            point_targets: self.inward(&handles.point_targets),
            ..handles.clone()
        }
    }

    /// Converts the targets of soft handles to normalized positions.
    pub fn soft(&self, soft: &SoftPull) -> SoftPull {
        soft.toward(self.inward(soft.targets()))
    }

    /// Converts a squared distance to given coordinates.
    pub fn squared(&self, distance: f64) -> f64 {
        distance * self.unit * self.unit
    }

    fn body(&self, body: &Body) -> Body {
        let elements = match &body.elements {
            BodyElements::Triangles { corners, rest } => BodyElements::Triangles {
                corners: corners.clone(),
                rest: rest.iter().map(|shape| shape.in_unit(self.unit)).collect(),
            },
            BodyElements::Tetrahedra { corners, rest } => BodyElements::Tetrahedra {
                corners: corners.clone(),
                rest: rest.iter().map(|shape| shape.in_unit(self.unit)).collect(),
            },
        };
        Body {
            rest: self.inward(&body.rest),
            elements,
        }
    }
}

/// Returns the mean size of elements; 1 without elements.
fn mean_size<const D: usize>(rest: &[RestShape<D>]) -> f64 {
    match rest.len() {
        0 => 1.0,
        n => rest.iter().map(|shape| shape.size).sum::<f64>() / n as f64,
    }
}

impl Problem {
    /// Returns the problem in the unit in which its numbers are meant, and the frame of that unit.
    pub(super) fn normalized(&self) -> (Self, Frame) {
        let frame = Frame::of(&self.body);
        let (body, start) = (frame.body(&self.body), frame.inward(&self.start));
        let boundary_barrier = match (&self.boundary_barrier, &body.elements) {
            (Some(_), BodyElements::Triangles { corners, .. }) => {
                Some(BoundaryBarrier::new(corners, &start))
            }
            _ => None,
        };
        let mut barrier = self.barrier;
        barrier.epsilon /= frame.unit.powi(body.dim() as i32);
        let stations = self.stations.iter().map(|handles| frame.handles(handles));
        let problem = Self {
            start,
            barrier,
            boundary_barrier,
            stations: stations.collect(),
            soft: frame.soft(&self.soft),
            units: Units::Given,
            body,
            ..self.clone()
        };
        (problem, frame)
    }
}

/// Shows the iterates of a normalized problem in the caller's coordinates.
pub(super) struct Restored<'a> {
    watch: &'a dyn Watch,
    frame: &'a Frame,
    /// Workspace for positions, so that iterations allocate nothing.
    x: RefCell<Vec<f64>>,
}

impl<'a> Restored<'a> {
    pub fn to(watch: &'a dyn Watch, frame: &'a Frame) -> Self {
        Self {
            watch,
            frame,
            x: RefCell::default(),
        }
    }
}

impl Restored<'_> {
    fn restored(&self, iterate: &Iterate) -> Iterate {
        Iterate {
            residual: self.frame.squared(iterate.residual),
            ..*iterate
        }
    }
}

impl Watch for Restored<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self.watch.iterate(&self.restored(iterate))
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        let mut restored = self.x.borrow_mut();
        restored.clear();
        restored.extend(self.frame.places(x));
        self.watch.positions(&self.restored(iterate), &restored);
    }
}

// Quality of a map, independent of its origin.

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
