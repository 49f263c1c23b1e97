//! Smoothing of noisy vertex positions.

use super::Surface;
use super::edges::{Edges, next, origin};

/// Number of smoothing passes. Together they remove noise a few edges wide and preserve the shape.
const PASSES: usize = 10;
/// Steps toward the mean of the neighbors and back, per pass: Taubin's λ and μ, which keep frequencies below the pass
/// band 1/0.5 − 1/0.53 = 0.11.
const STEPS: [f64; 2] = [0.5, -0.53];

impl Surface {
    /// Returns the positions after ten passes of Taubin's λ|μ filter with uniform weights (*A Signal Processing
    /// Approach to Fair Surface Design*, 1995). Vertices of `is_on_border` follow their neighbors along the border.
    /// O(n).
    pub fn smoothed(&self, is_on_border: &[bool]) -> Vec<[f64; 3]> {
        let pulls = self.pulls(is_on_border);
        let mut count = vec![0.0_f64; self.positions.len()];
        for [v, _] in &pulls {
            count[*v as usize] += 1.0;
        }
        let mut positions = self.positions.clone();
        for step in [STEPS; PASSES].into_iter().flatten() {
            let mut sums = vec![[0.0; 3]; positions.len()];
            for [v, neighbor] in pulls.iter().map(|pull| pull.map(|v| v as usize)) {
                for (k, sum) in sums[v].iter_mut().enumerate() {
                    *sum += positions[neighbor][k] - positions[v][k];
                }
            }
            for ((p, sum), count) in positions.iter_mut().zip(sums).zip(&count) {
                for (x, s) in p.iter_mut().zip(sum) {
                    *x += step * s / count.max(1.0);
                }
            }
        }
        positions
    }

    /// Returns for each vertex whether it lies on a border: an edge of one face.
    pub fn is_on_border(&self) -> Vec<bool> {
        let mut is_on_border = vec![false; self.positions.len()];
        for edge in Edges::new(self.positions.len(), &self.triangles).iter() {
            if let [h] = edge {
                for v in self.ends(*h) {
                    is_on_border[v as usize] = true;
                }
            }
        }
        is_on_border
    }

    /// Returns each vertex with each neighbor that it follows.
    fn pulls(&self, is_on_border: &[bool]) -> Vec<[u32; 2]> {
        let mut pulls = Vec::with_capacity(3 * self.triangles.len());
        for edge in Edges::new(self.positions.len(), &self.triangles).iter() {
            let [a, b] = self.ends(edge[0]);
            for [v, neighbor] in [[a, b], [b, a]] {
                if edge.len() == 1 || !is_on_border[v as usize] {
                    pulls.push([v, neighbor]);
                }
            }
        }
        pulls
    }

    fn ends(&self, h: u32) -> [u32; 2] {
        [h, next(h)].map(|h| origin(&self.triangles, h))
    }
}
