//! The main loop of the minimization.

use super::directions::Directions;
use super::line_search::{Search, line_search};
use super::objective::Objective;
use super::relaxation::Relaxation;
use super::settings::{Settings, Status, Summary};
use super::trust_region::End;
use super::watch::{Control, Taken, Watch};

/// Shortest step that confirms the prediction for a full one: less than a quarter of the predicted decrease is left to
/// gain.
const CONFIRMING: f64 = 0.5;

/// Moves `x` from a start inside the domain to a nearby minimum of `objective`.
///
/// `x` is flat, the coordinates of a vertex one after another. A start outside the domain is left unchanged and
/// reported as [`Status::Stalled`]. The energy falls with every step. Cost per iteration: far from a minimum one
/// factorization, one solve, one assembly and about 1.2 evaluations; near one a fifth of a factorization, two to eleven
/// solves and products with the Hessian, one assembly and one or two evaluations. After the first iteration no memory
/// is allocated (`tests/allocations.rs` counts), except by terms that [renew](crate::energy::Term::renew) their
/// stencils.
///
/// # Panics
/// If `x` does not hold the coordinates of the objective's vertices.
pub fn minimize(
    objective: &mut Objective,
    x: &mut [f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Summary {
    let mut relaxation = Relaxation::new(settings.projection);
    minimize_with(&mut relaxation, objective, x, settings, watch)
}

/// Like [`minimize`], starting from a known relaxation of the Hessian.
pub(super) fn minimize_with(
    relaxation: &mut Relaxation,
    objective: &mut Objective,
    x: &mut [f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Summary {
    assert_eq!(x.len(), objective.n(), "coordinates of every vertex");
    let mut directions = Directions::new(x.len());
    let mut trial = vec![0.0; x.len()];
    let mut summary = Summary::at_start(objective.value(x));
    if !summary.energy_first.is_finite() {
        return summary;
    }
    if objective.show(x, &summary, Taken::default(), watch) == Control::Finish {
        return summary.ended(Status::Stopped);
    }
    // After the start was shown: who only wants a valid map, or has no time left, does not wait for it.
    directions.prepare(objective, settings.projection);
    while summary.iterations < settings.max_iterations {
        let energy = summary.energy_last;
        let negligible = settings.tolerance * objective.reference(energy);
        let factorizations = &mut summary.factorizations;
        let Some(descent) = directions.next(objective, x, negligible, relaxation, factorizations)
        else {
            return summary.ended(Status::Stalled);
        };
        let is_small = descent.end == End::Minimum && -descent.change <= negligible;
        let search = Search {
            x,
            direction: &directions.direction,
            energy,
            slope: descent.slope,
        };
        let Some(step) = line_search(objective, &search, &mut trial) else {
            if is_small {
                return summary.ended(Status::Converged);
            }
            if directions.after_useless_direction(relaxation) {
                continue;
            }
            return summary.ended(Status::Stalled);
        };
        x.copy_from_slice(&trial);
        summary.iterations += 1;
        summary.energy_last = step.energy;
        directions.after_step(relaxation, &descent, energy, step);
        let taken = Taken {
            mu: objective.shift(),
            sigma: step.length,
        };
        if objective.show(x, &summary, taken, watch) == Control::Finish {
            return summary.ended(Status::Stopped);
        }
        if is_small && step.length >= CONFIRMING {
            return summary.ended(Status::Converged);
        }
    }
    summary.ended(Status::IterationLimit)
}
