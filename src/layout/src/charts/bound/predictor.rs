//! How much a disk would be distorted, without mapping it.

use std::f64::consts::TAU;
use unwrapd_maps::embed::rest_shapes;
use unwrapd_method::numerics::cholesky::{Cholesky, SymmetricPattern};

/// The logarithm of the scale of a conformal flattening whose boundary keeps its length, for a disk that is slit again and again.
///
/// ```text
/// L u = K,   u = 0 on the boundary and on slits
/// ```
/// with the cotangent stiffness L and the angle defects K of interior vertices: the flattening scales lengths at a vertex by eᵘ.
/// A real map trades angles for areas and is three to six times nearer to an isometry, but where and in which order a disk
/// wants to be cut the two agree on. A slit only fixes vertices: they part its sides as the cut itself would.
///
/// From: Springborn, Schröder, Pinkall 2008 and Sawhney, Crane 2018, Boundary First Flattening.
pub struct Predictor {
    cholesky: Cholesky,
    pattern: SymmetricPattern,
    /// The entries of L, in the order of the pattern.
    stiffness: Vec<f64>,
    /// K of each vertex.
    curvature: Vec<f64>,
    /// A third of the area of the triangles at each vertex.
    area: Vec<f64>,
}

/// The largest logarithm of a scale that counts in the energy: beyond e⁴ a few vertices would outweigh all others.
const LARGEST: f64 = 4.0;

impl Predictor {
    /// For triangles over their positions.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let rest = rest_shapes(positions, triangles);
        let n = positions.len();
        let mut curvature = vec![TAU; n];
        let mut area = vec![0.0; n];
        let mut entries: Vec<(u32, u32, f64)> = Vec::with_capacity(6 * triangles.len());
        let unit = rest.scale * rest.scale;
        for (triangle, shape) in triangles.iter().zip(&rest.shapes) {
            let [g1, g2] = shape.inverse;
            let g0 = [-g1[0] - g2[0], -g1[1] - g2[1]];
            let gradients = [g0, g1, g2];
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (g, h) = (gradients[i], gradients[j]);
                let (dot, cross) = (g[0] * h[0] + g[1] * h[1], g[0] * h[1] - g[1] * h[0]);
                let [a, b, c] = [triangle[i], triangle[j], triangle[k]];
                entries.push((a.min(b), a.max(b), shape.size * dot));
                let own = gradients[k];
                entries.push((c, c, shape.size * (own[0] * own[0] + own[1] * own[1])));
                curvature[c as usize] -= cross.abs().atan2(-dot);
                area[c as usize] += shape.weight * unit / 3.0;
            }
        }
        let (pattern, stiffness) = SymmetricPattern::from_entries(n, entries);
        Self {
            cholesky: Cholesky::analyze(&pattern, 1),
            pattern,
            stiffness,
            curvature,
            area,
        }
    }

    /// u of every vertex, 0 where `is_fixed`; 0 everywhere if the system cannot be solved. One factorization.
    pub fn log_scale(&mut self, is_fixed: &[bool]) -> Vec<f64> {
        let mut values = self.stiffness.clone();
        for (column, range) in self.pattern.col_ptr.windows(2).enumerate() {
            for k in range[0] + 1..range[1] {
                if is_fixed[column] || is_fixed[self.pattern.row_idx[k]] {
                    values[k] = 0.0;
                }
            }
            // Also where triangles without extent leave nothing.
            values[range[0]] = values[range[0]].max(f64::MIN_POSITIVE);
        }
        let mut u: Vec<f64> = (self.curvature.iter().zip(is_fixed))
            .map(|(&k, &fixed)| if fixed { 0.0 } else { k })
            .collect();
        if self.cholesky.factor(&values).is_err() {
            return vec![0.0; u.len()];
        }
        self.cholesky.solve(&mut u, 1);
        u
    }

    /// The sum of the areas.
    pub fn area(&self) -> f64 {
        self.area.iter().sum()
    }

    /// By how much the symmetric Dirichlet energy of the conformal flattening, at its best size, exceeds 4 per area, summed over
    /// the area.
    pub fn excess(&self, log_scale: &[f64]) -> f64 {
        let weighted = |f: &dyn Fn(f64) -> f64| -> f64 {
            self.area
                .iter()
                .zip(log_scale)
                .map(|(a, u)| a * f(u.clamp(-LARGEST, LARGEST)))
                .sum()
        };
        let mean = weighted(&|u| u) / self.area().max(f64::MIN_POSITIVE);
        weighted(&|u| 4.0 * ((2.0 * (u - mean)).cosh() - 1.0))
    }
}
