//! How a disk is mapped, and what comes of it.

use super::pins::Pins;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::EnergyKind;
use unwrapd_method::solver::{Settings, Summary};

/// What is minimized, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The density.
    pub energy: EnergyKind,
    /// The barrier; without one [`EnergyKind::Arap`] and [`EnergyKind::Lscm`] may flip triangles.
    pub barrier: BarrierKind,
    /// β, the barrier's strength, when the mean rest area is 1.
    pub beta: f64,
    /// s, the share of its rest area below which a triangle feels the barrier.
    pub s: f64,
    /// What stays where the start has it.
    pub pins: Pins,
    /// When to stop.
    pub solver: Settings,
}

impl Default for Options {
    /// ARAP with the inverse-spline barrier, β = 0.01, s = 1.
    fn default() -> Self {
        Self {
            energy: EnergyKind::default(),
            barrier: BarrierKind::default(),
            beta: 0.01,
            s: 1.0,
            pins: Pins::None,
            solver: Settings::default(),
        }
    }
}

/// A map of a disk and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// One position per vertex, in the mesh's unit of length, counter-clockwise; the sum of the areas in the plane is
    /// that of the triangles in space (of their rest shapes, if none has an area).
    pub uv: Vec<[f64; 2]>,
    /// Energies in it are for a mean rest area of 1.
    pub summary: Summary,
}
