//! How far to go along a direction.

use super::objective::Objective;

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Its length as a share of the direction.
    pub length: f64,
    /// The energy after it.
    pub energy: f64,
}

/// Where a search begins and where it leads.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    /// The point.
    pub x: &'a [f64],
    /// The direction.
    pub direction: &'a [f64],
    /// The energy at the point.
    pub energy: f64,
    /// The slope of the energy along the direction, negative.
    pub slope: f64,
}

/// Share of the way to the first inversion that a step may take: the triangle that limits it keeps a twentieth of its
/// margin, so that the next direction is not stuck at the barrier.
const SAFETY: f64 = 0.95;

/// Armijo's share of the decrease that the slope promises.
const SUFFICIENT: f64 = 1e-4;

/// Halvings before a direction is given up: a step below 2⁻⁴⁰ moves nothing that matters.
const MAX_HALVINGS: usize = 40;

/// The longest of the steps t, t/2, t/4, … that lowers the energy enough, `trial` being where it leads; t is 1 or 0.95
/// of the largest step inside the domain.
///
/// `None` if no step is good: the energy is at rounding, or the direction is useless. Usually one evaluation, because the
/// search starts inside the domain.
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
