//! Options and results of mapping a disk.

use std::sync::Arc;

use super::pins::Pins;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::{Arap, Density};
use unwrapd_method::solver::{Settings, Summary};

/// Objective and stopping criteria.
#[derive(Clone, Debug)]
pub struct Options {
    /// ψ: one of the library's or a caller's own.
    pub density: Arc<dyn Density<2>>,
    /// Barrier; without one, densities that are finite for flipped triangles may flip them.
    pub barrier: BarrierKind,
    /// β, the barrier's strength, for a mean rest area of 1.
    pub beta: f64,
    /// s, the share of its rest area below which the barrier of a triangle is nonzero.
    pub s: f64,
    /// Vertices that keep their places of the start.
    pub pins: Pins,
    /// Settings of the solver.
    pub solver: Settings,
}

impl Default for Options {
    /// Returns ARAP with the inverse-spline barrier, β = 0.01, s = 1.
    fn default() -> Self {
        Self {
            density: Arc::new(Arap),
            barrier: BarrierKind::default(),
            beta: 0.01,
            s: 1.0,
            pins: Pins::None,
            solver: Settings::default(),
        }
    }
}

/// A map of a disk and the summary of its optimization.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// One position per vertex, in the mesh's unit of length, counter-clockwise; the sum of the areas in the plane is
    /// that of the triangles in space (or of their rest shapes, if none has an area).
    pub uv: Vec<[f64; 2]>,
    /// Summary of the solver; energies are for a mean rest area of 1.
    pub summary: Summary,
}
