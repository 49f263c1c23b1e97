//! The true Hessian within a trust region, by conjugate gradients that an older factorization preconditions.
//!
//! Why: at the minimum of ARAP with a barrier four of five triangles are compressed a little, and each of those has a
//! negative eigenvalue. The sum is positive definite there nevertheless; but with all of them removed the matrix is far
//! too stiff along the modes in which a surface buckles, and Newton's method converges linearly. Away from the minimum
//! the true Hessian is mostly indefinite, and so is every compromise that would be soft enough. But the eigenvalues of
//! the true Hessian relative to the projected one are at most 1 and mostly near 1, which suits conjugate gradients: a
//! few products find the modes that matter, negative curvature included. One factorization serves several steps,
//! because it need not be that of the present point. On ordinary disks ARAP with the barrier takes a fifth of the
//! factorizations of [`Projection::Relaxed`](super::Projection::Relaxed) (`cargo bench --bench disks` counts them).
//!
//! From: Steihaug 1983, The Conjugate Gradient Method and Trust Regions in Large Scale Optimization.

use super::objective::Objective;
use crate::numerics::cholesky::NotPositiveDefinite;

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
    pub end: End,
}

impl Descent {
    /// Returns the properties of Newton's direction with this decrement, in the norm of its own matrix.
    pub fn of_newton(decrement: f64) -> Self {
        Self {
            slope: -2.0 * decrement,
            change: -decrement,
            norm: (2.0 * decrement).sqrt(),
            products: 0,
            end: End::Minimum,
        }
    }
}

/// Reason why conjugate gradients ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
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
                break End::Minimum;
            }
            if products == MOST_PRODUCTS {
                break End::Limit;
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
            (lowest.min(most), (!is_inside).then_some(End::Radius))
        } else {
            (most, Some(End::NegativeCurvature))
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
        } else if decrease > 0.75 * foretold && descent.end != End::Minimum {
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
    end: Option<End>,
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
