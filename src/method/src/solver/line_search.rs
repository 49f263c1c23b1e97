//! Line search.

use super::objective::Objective;

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Length, as a share of the direction.
    pub length: f64,
    /// Energy after the step.
    pub energy: f64,
}

/// Start and direction of a line search.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    /// Start.
    pub x: &'a [f64],
    /// Direction.
    pub direction: &'a [f64],
    /// Energy at the start.
    pub energy: f64,
    /// Slope of the energy along the direction, negative.
    pub slope: f64,
}

/// Share of the distance to the first inversion that a step may take: the triangle that limits it keeps a twentieth of
/// its margin, so that the next direction is not stuck at the barrier.
const SAFETY: f64 = 0.95;

/// Armijo constant: share of the decrease predicted by the slope that a step must reach. The customary value (Nocedal
/// and Wright 2006, section 3.1).
const SUFFICIENT: f64 = 1e-4;

/// Most halvings: a step below 2⁻⁴⁰, about 1e-12, has no relevant effect.
const MAX_HALVINGS: usize = 40;

/// Returns the longest of the steps t, t/2, t/4, … that lowers the energy sufficiently, with its end point in `trial`;
/// t is the smaller of 1 and 0.95 times the largest step inside the domain.
///
/// Returns `None` if no step lowers the energy: it is at rounding, or the direction is useless. Usually takes one
/// evaluation, because the search starts inside the domain.
pub fn line_search(objective: &Objective, search: &Search, trial: &mut [f64]) -> Option<Step> {
    let &Search {
        x,
        direction,
        energy,
        slope,
    } = search;
    let mut length = (SAFETY * objective.largest_step(x, direction)).min(1.0);
    for _ in 0..MAX_HALVINGS {
        for ((trial, x), d) in trial.iter_mut().zip(x).zip(direction) {
            *trial = x + length * d;
        }
        let new_energy = objective.value(trial);
        if new_energy < energy && new_energy <= energy + SUFFICIENT * length * slope {
            return Some(Step {
                length,
                energy: new_energy,
            });
        }
        length *= 0.5;
    }
    None
}
