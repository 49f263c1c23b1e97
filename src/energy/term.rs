//! What the solver asks of an energy.

use crate::numerics::block::BlockPattern;

/// A sum over triangles of functions of their vertices' positions in the plane.
///
/// Positions `x` are flat: coordinates of vertex `v` at `2v` and `2v + 1`. All sums run in the order of the triangles,
/// so results depend on the arguments alone.
pub trait Term: Send + Sync {
    /// The vertices of each triangle in increasing order, whatever their orientation.
    fn stencils(&self) -> Vec<[u32; 3]>;

    /// The value that counts as large: the sum of the weights. An energy far below it is rounding.
    fn scale(&self) -> f64;

    /// The sum, +∞ as soon as one triangle is outside the domain.
    fn value(&self, x: &[f64]) -> f64;

    /// Adds the gradient at `x` to `gradient`, and the Hessian, with negative eigenvalues of each triangle's share
    /// multiplied by `tau`, to `hessian`, the values of `pattern` (made from the [`stencils`](Term::stencils)).
    fn add_derivatives(
        &self,
        x: &[f64],
        tau: f64,
        pattern: &BlockPattern,
        gradient: &mut [f64],
        hessian: &mut [f64],
    );

    /// The smallest t > 0 at which `x + t·direction` leaves the domain, +∞ if it never does.
    fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64;

    /// The smallest det J: the smallest area of a triangle over its rest area, negative where one is flipped.
    fn smallest(&self, x: &[f64]) -> f64;

    /// Does the domain exclude every flipped triangle?
    fn forbids_flips(&self) -> bool;

    /// The sum over the triangles `around` a vertex.
    fn value_around(&self, around: &[u32], x: &[f64]) -> f64;

    /// The derivatives of that sum in the vertex's two coordinates, the Hessian projected.
    fn derivatives_around(&self, vertex: u32, around: &[u32], x: &[f64]) -> Local;
}

/// First and second derivatives in the coordinates of one vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Local {
    /// ∂/∂u, ∂/∂v.
    pub gradient: [f64; 2],
    /// h₀₀, h₁₀, h₁₁, positive semidefinite.
    pub hessian: [f64; 3],
}

impl Local {
    /// Adds one triangle's share.
    pub fn add(&mut self, gradient: [f64; 2], hessian: [f64; 3]) {
        for (sum, share) in self.gradient.iter_mut().zip(gradient) {
            *sum += share;
        }
        for (sum, share) in self.hessian.iter_mut().zip(hessian) {
            *sum += share;
        }
    }

    /// The Newton direction −H⁻¹g, with H shifted by 1e-9 of its trace so that it exists.
    pub fn newton_direction(&self) -> [f64; 2] {
        let [mut h00, h10, mut h11] = self.hessian;
        let shift = 1e-9 * (h00 + h11) + f64::MIN_POSITIVE;
        h00 += shift;
        h11 += shift;
        let det = h00 * h11 - h10 * h10;
        let [g0, g1] = self.gradient;
        [(h10 * g1 - h11 * g0) / det, (h10 * g0 - h00 * g1) / det]
    }
}
