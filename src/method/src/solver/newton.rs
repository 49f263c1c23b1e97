//! The main loop of the minimization.

use super::objective::Objective;
use super::relaxation::{
    LineSearch, Relaxation, Step, is_settling, line_search, newton_direction, once_definite,
};
use super::settings::{Control, Projection, Settings, Status, Summary, Taken, Watch};
use crate::numerics::cholesky::NotPositiveDefinite;

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
        let is_small = descent.end == DescentEnd::Minimum && -descent.change <= negligible;
        let search = LineSearch {
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
        self.met_negative |= descent.end == DescentEnd::NegativeCurvature;
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

// The true Hessian within a trust region, by conjugate gradients that an older factorization preconditions.

/// Most products with the Hessian per direction: more are better spent at another point.
const MOST_PRODUCTS: usize = 10;

/// Norm of the residual, as a share of the gradient's, at which a direction is accurate enough. A tenth took as long
/// when it was chosen.
const FORCING: f64 = 0.3;

/// Required accuracy of a direction that would be the last: slow modes hide in a residual.
const SURE: f64 = 0.03;

/// First radius as a multiple of the last Newton step, which was a good one.
const FIRST_RADIUS: f64 = 3.0;

/// Factors of the radius after a step that the model predicted badly, and well. A quarter is customary (Nocedal and
/// Wright 2006, algorithm 4.1); growing by 4 in place of its 2 opens the region in half as many steps.
const SHRINK: f64 = 0.25;
const GROW: f64 = 4.0;

/// The ball in which the quadratic model is trusted, in the norm ‖d‖² = d·Pd of the factored matrix P.
pub struct TrustRegion {
    radius: f64,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    conjugate: Vec<f64>,
    product: Vec<f64>,
}

/// Properties of a direction d.
#[derive(Clone, Copy, Debug)]
pub struct Descent {
    /// g·d, negative.
    pub slope: f64,
    /// g·d + ½d·Hd, negative.
    pub change: f64,
    /// Norm of d.
    pub norm: f64,
    /// Number of products with the Hessian.
    pub products: usize,
    /// Reason why conjugate gradients ended.
    pub end: DescentEnd,
}

impl Descent {
    /// Returns the properties of Newton's direction with this decrement, in the norm of its own matrix.
    pub fn of_newton(decrement: f64) -> Self {
        Self {
            slope: -2.0 * decrement,
            change: -decrement,
            norm: (2.0 * decrement).sqrt(),
            products: 0,
            end: DescentEnd::Minimum,
        }
    }
}

/// Reason why conjugate gradients ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DescentEnd {
    /// At the model's minimum.
    Minimum,
    /// At the radius, with a convex model up to there.
    Radius,
    /// At the radius, along negative curvature.
    NegativeCurvature,
    /// At the limit on products per direction.
    Limit,
}

impl TrustRegion {
    /// Allocates the workspace for `n` unknowns; [`begin`](Self::begin) sets the radius.
    pub fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self {
            radius: 0.0,
            residual: zeros(),
            preconditioned: zeros(),
            conjugate: zeros(),
            product: zeros(),
        }
    }

    /// Sets the radius after a good Newton step of this norm.
    pub fn begin(&mut self, norm: f64) {
        self.radius = FIRST_RADIUS * norm;
    }

    /// Writes an approximate minimizer of the model within the region to `direction`.
    ///
    /// The objective must be linearized with its true Hessian and have a factorization, of any nearby positive definite
    /// matrix. A direction whose change is less than `negligible` is refined further, so that a poor factorization does
    /// not look like convergence. Cost: a solve and a product with the Hessian per step of conjugate gradients, and one
    /// solve.
    ///
    /// # Errors
    /// If the preconditioner is not positive definite.
    pub fn direction(
        &mut self,
        objective: &mut Objective,
        negligible: f64,
        direction: &mut [f64],
    ) -> Result<Descent, NotPositiveDefinite> {
        // Start from d = 0, whose residual is the gradient.
        direction.fill(0.0);
        self.residual.copy_from_slice(objective.gradient());
        let first = self.precondition(objective)?;
        self.turn(0.0);
        let mut norms = Norms::of_first(first);
        let mut rz = first;
        let mut change = 0.0;
        let mut products = 0;
        let end = loop {
            // Go to the lowest point along the conjugate direction, or to the radius.
            let step = self.step(objective, &norms, rz);
            products += 1;
            add_scaled(direction, step.alpha, &self.conjugate);
            change += step.alpha * (0.5 * step.alpha * step.curvature - rz);
            norms.advance(step.alpha);
            if let Some(end) = step.end {
                break end;
            }
            // Stop if the residual is small enough.
            add_scaled(&mut self.residual, step.alpha, &self.product);
            let next = self.precondition(objective)?;
            let share = if -change <= negligible { SURE } else { FORCING };
            if next <= share * share * first {
                break DescentEnd::Minimum;
            }
            if products == MOST_PRODUCTS {
                break DescentEnd::Limit;
            }
            // Turn to the next conjugate direction.
            let beta = next / rz;
            self.turn(beta);
            norms.turn(beta, next);
            rz = next;
        };
        Ok(Descent {
            slope: dot(objective.gradient(), direction),
            change,
            norm: norms.direction.sqrt(),
            products,
            end,
        })
    }

    /// Computes the step along the conjugate direction, to the lowest point on it or to the radius. Leaves the product
    /// of the conjugate direction with the Hessian in `product`.
    fn step(&mut self, objective: &Objective, norms: &Norms, rz: f64) -> ConjugateStep {
        objective.apply_hessian(&self.conjugate, &mut self.product);
        let curvature = dot(&self.conjugate, &self.product);
        let most = norms.step_to(self.radius);
        let (alpha, end) = if curvature > 0.0 {
            let lowest = rz / curvature;
            let is_inside = lowest < most;
            (lowest.min(most), (!is_inside).then_some(DescentEnd::Radius))
        } else {
            (most, Some(DescentEnd::NegativeCurvature))
        };
        ConjugateStep {
            alpha,
            curvature,
            end,
        }
    }

    /// Replaces the conjugate direction by the next one, βp − z.
    fn turn(&mut self, beta: f64) {
        for (p, z) in self.conjugate.iter_mut().zip(&self.preconditioned) {
            *p = beta * *p - z;
        }
    }

    /// Computes P⁻¹r and returns r·P⁻¹r.
    fn precondition(&mut self, objective: &mut Objective) -> Result<f64, NotPositiveDefinite> {
        self.preconditioned.copy_from_slice(&self.residual);
        objective.precondition(&mut self.preconditioned)?;
        Ok(dot(&self.residual, &self.preconditioned))
    }

    /// Adapts the radius to a step of this length along a direction.
    pub fn after_step(&mut self, descent: &Descent, length: f64, decrease: f64) {
        let Descent { slope, change, .. } = descent;
        let foretold = -length * (slope + length * (change - slope));
        if length < 1.0 {
            self.radius = length.max(SHRINK) * descent.norm;
        } else if decrease < 0.25 * foretold {
            self.radius = SHRINK * descent.norm;
        } else if decrease > 0.75 * foretold && descent.end != DescentEnd::Minimum {
            self.radius = self.radius.max(GROW * descent.norm);
        }
    }

    /// Changes to another norm, in which a direction of norm `from` has the norm `to`.
    pub fn rescale(&mut self, from: f64, to: f64) {
        self.radius *= to / from;
    }
}

/// A step of conjugate gradients.
struct ConjugateStep {
    alpha: f64,
    /// p·Hp.
    curvature: f64,
    /// Reason why conjugate gradients end after it; `None` if they continue.
    end: Option<DescentEnd>,
}

/// Squared norms of the direction d so far and of the conjugate direction p, and their product, updated without the
/// matrix.
struct Norms {
    direction: f64,
    mixed: f64,
    conjugate: f64,
}

impl Norms {
    /// Returns the norms before the first conjugate direction, which has this squared norm.
    fn of_first(conjugate: f64) -> Self {
        Self {
            direction: 0.0,
            mixed: 0.0,
            conjugate,
        }
    }

    /// Returns the t > 0 at which the norm of d + tp is the radius.
    fn step_to(&self, radius: f64) -> f64 {
        let missing = (radius * radius - self.direction).max(0.0);
        let root = (self.mixed * self.mixed + self.conjugate * missing).sqrt();
        (root - self.mixed) / self.conjugate
    }

    /// Updates the norms for d ← d + tp.
    fn advance(&mut self, t: f64) {
        self.direction += t * (2.0 * self.mixed + t * self.conjugate);
        self.mixed += t * self.conjugate;
    }

    /// Updates the norms for p ← βp − z, where z is orthogonal to p and d and has the squared norm `z`.
    fn turn(&mut self, beta: f64, z: f64) {
        self.mixed *= beta;
        self.conjugate = z + beta * beta * self.conjugate;
    }
}

fn add_scaled(sum: &mut [f64], factor: f64, share: &[f64]) {
    for (sum, share) in sum.iter_mut().zip(share) {
        *sum += factor * share;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
