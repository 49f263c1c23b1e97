//! Small perturbations that break symmetries.

use super::problem::Problem;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Objective;

/// Distance by which free vertices are moved from exact rest, in edges of the smallest element. A straight bar that is
/// pressed then buckles at once instead of staying on the saddle of its symmetry.
const SHAKE: f64 = 1e-3;

impl Problem {
    /// Moves free vertices a little, each toward another one drawn from a fixed seed, independent of unit, place and
    /// direction. Does nothing if that would leave the domain.
    pub(super) fn shake(&self, objective: &Objective, x: &mut [f64]) {
        let (dim, n_vertices) = (self.body.dim(), self.body.n_vertices());
        let sizes = self.body.determinants().into_iter();
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        let amplitude = SHAKE * smallest.powf(1.0 / dim as f64);
        let mut is_held = vec![false; n_vertices];
        for &v in self.stations.iter().flat_map(|handles| &handles.vertices) {
            is_held[v as usize] = true;
        }
        let mut random = Random::new(0);
        let mut moves = vec![0.0; x.len()];
        for v in 0..n_vertices {
            let (other, share) = (random.below(n_vertices), random.unit());
            let path = |k: usize| x[dim * other + k] - x[dim * v + k];
            let length = (0..dim).map(|k| path(k) * path(k)).sum::<f64>().sqrt();
            if is_held[v] || length == 0.0 {
                continue;
            }
            for k in 0..dim {
                moves[dim * v + k] = amplitude * share * path(k) / length;
            }
        }
        if objective.largest_step(x, &moves) > 1.0 {
            for (x, d) in x.iter_mut().zip(moves) {
                *x += d;
            }
        }
    }
}
