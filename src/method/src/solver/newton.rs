//! The main loop of the minimization.

use super::line_search::{Search, Step, line_search};
use super::newton_direction::{newton_direction, once_definite};
use super::objective::Objective;
use super::relaxation::{Relaxation, is_settling};
use super::settings::{Projection, Settings, Status, Summary};
use super::trust_region::{Descent, End, TrustRegion};
use super::watch::{Control, Taken, Watch};

/// Shortest step that confirms the prediction for a full one: less than (1 − ½)², a quarter, of the predicted decrease
/// is left to gain. Asking for a full step cost large charts one or two factorizations for 1e-5 of the energy.
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
    // Refuse a start outside the domain; show a valid one.
    let mut directions = DescentDirections::new(x.len());
    let mut trial = vec![0.0; x.len()];
    let mut summary = Summary::at_start(objective.value(x));
    if !summary.energy_first.is_finite() {
        return summary;
    }
    if objective.show(x, &summary, Taken::default(), watch) == Control::Finish {
        return summary.ended(Status::Stopped);
    }
    // Analyze only now: a watcher that wants just a valid map, or has no time left, has ended already.
    directions.prepare(objective, settings.projection);
    while summary.iterations < settings.max_iterations {
        // Find a direction.
        let energy = summary.energy_last;
        let negligible = settings.tolerance * objective.reference(energy);
        let factorizations = &mut summary.factorizations;
        let Some(descent) = directions.next(objective, x, negligible, relaxation, factorizations)
        else {
            return summary.ended(Status::Stalled);
        };
        // Search along it. If no step helps, retry with a safer matrix.
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
        // Take the step, and adapt the next direction to it.
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
        // Believe a small prediction only if a step of at least half the direction confirms it.
        if is_small && step.length >= CONFIRMING {
            return summary.ended(Status::Converged);
        }
    }
    summary.ended(Status::IterationLimit)
}

// Choice of the descent direction: Newton's method far from a minimum, a trust region near one.

/// Most directions that one factorization serves; after that many steps it belongs to a distant point.
const MOST_DIRECTIONS: usize = 6;

/// Products with the Hessian after which a better factorization is cheaper than more of them.
const ENOUGH_PRODUCTS: usize = 20;

/// Fewest directions that one factorization serves: where the true Hessian is indefinite no factorization is better.
const LEAST_DIRECTIONS: usize = 3;

/// Finds directions of descent and adapts to the steps taken along them.
struct DescentDirections {
    pub direction: Vec<f64>,
    /// The trust region; `None` if every direction is Newton's.
    region: Option<TrustRegion>,
    /// `true` if the next direction comes from the region.
    is_near: bool,
    served: usize,
    products: usize,
    met_negative: bool,
    /// Decrease of the energy in the last step, as a share of the energy.
    relative_decrease: f64,
    norm: f64,
}

impl DescentDirections {
    /// Creates the state for `n` unknowns; directions are Newton's until it is [prepared](Self::prepare).
    pub fn new(n: usize) -> Self {
        Self {
            direction: vec![0.0; n],
            region: None,
            is_near: false,
            served: 0,
            products: 0,
            met_negative: false,
            relative_decrease: 1.0,
            norm: 0.0,
        }
    }

    /// Allocates the trust region if the settings ask for one. An objective whose Hessian is too large to factor keeps
    /// to Newton's method.
    pub fn prepare(&mut self, objective: &mut Objective, projection: Projection) {
        if objective.keeps_factor() && projection == Projection::TrustRegion {
            self.region = Some(TrustRegion::new(objective.n()));
        }
    }

    /// Writes the next direction to `direction`. A predicted change below `negligible` counts as the last one. Returns
    /// `None` if no matrix could be factored. Falls back to Newton's method if the region's preconditioner is not
    /// positive definite.
    pub fn next(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        negligible: f64,
        relaxation: &mut Relaxation,
        factorizations: &mut usize,
    ) -> Option<Descent> {
        let Some(region) = self.region.as_mut().filter(|_| self.is_near) else {
            return self.newton(objective, x, relaxation, factorizations);
        };
        // Renew a factorization that has served enough directions.
        let is_spent = self.products >= ENOUGH_PRODUCTS && self.served >= LEAST_DIRECTIONS;
        if is_spent || self.served >= MOST_DIRECTIONS {
            relaxation.after_service(self.met_negative, self.relative_decrease);
            once_definite(objective, x, relaxation, factorizations, Objective::factor)?;
            region.rescale(self.norm, objective.curvature(&self.direction).sqrt());
            (self.served, self.products, self.met_negative) = (0, 0, false);
        }
        // Find a direction within the trust region; without a definite preconditioner, use Newton's method.
        objective.linearize(x, 1.0);
        let Ok(descent) = region.direction(objective, negligible, &mut self.direction) else {
            self.is_near = false;
            return self.newton(objective, x, relaxation, factorizations);
        };
        self.served += 1;
        self.products += descent.products;
        self.met_negative |= descent.end == End::NegativeCurvature;
        Some(descent)
    }

    /// Computes Newton's direction from a factorization at `x`.
    fn newton(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        relaxation: &mut Relaxation,
        factorizations: &mut usize,
    ) -> Option<Descent> {
        let direction = &mut self.direction;
        let decrement = newton_direction(objective, x, relaxation, direction, factorizations)?;
        (self.served, self.products, self.met_negative) = (0, 0, false);
        Some(Descent::of_newton(decrement))
    }

    /// Adapts to a step along `descent` that started at energy `energy`.
    pub fn after_step(
        &mut self,
        relaxation: &mut Relaxation,
        descent: &Descent,
        energy: f64,
        step: Step,
    ) {
        let (length, decrease) = (step.length, energy - step.energy);
        self.norm = descent.norm;
        self.relative_decrease = decrease / energy.abs();
        match &mut self.region {
            None => relaxation.after_step(length, self.relative_decrease),
            Some(region) if self.is_near => region.after_step(descent, length, decrease),
            Some(region) => {
                self.is_near = is_settling(length, self.relative_decrease);
                region.begin(descent.norm);
            }
        }
    }

    /// Adapts to a direction along which no step helped; returns `false` if there is no safer one.
    pub fn after_useless_direction(&mut self, relaxation: &mut Relaxation) -> bool {
        let was_near = std::mem::take(&mut self.is_near);
        relaxation.after_useless_direction() || was_near
    }
}
