//! The quadratic model of the function at a point: gradient, Hessian and solutions of systems with it.

use super::{Objective, all, pattern};
use crate::numerics::block::BlockPattern;
use crate::numerics::cholesky::{NotPositiveDefinite, Work};

impl Objective {
    /// Evaluates gradient and Hessian at `x`; the negative eigenvalues of each summand's Hessian are multiplied by
    /// `tau`.
    pub fn linearize(&mut self, x: &[f64], tau: f64) {
        let renewed = self.terms.iter_mut().map(|term| term.renew(x));
        if renewed.fold(false, |any, is_renewed| any | is_renewed) {
            self.renew_pattern();
        }
        self.model.clear();
        for (term, slots) in self.terms.iter().zip(&self.slots) {
            self.model.add(term.as_ref(), slots, x, tau);
        }
        // Measure before the constraints are added: their strength is not the energy's.
        self.model.measure();
        if let (Some(constraints), Some(slots)) = (&self.constraints, self.slots.last()) {
            self.model.add(constraints, slots, x, tau);
        }
        self.model.finish();
    }

    /// Evaluates only the gradient at `x`; Hessian and factorization stay those of another point. Returns `false` if
    /// there is no matching factorization, as after vertices were fixed, or where a term
    /// [renews](crate::energy::Term::renew) its stencils.
    ///
    /// Cost: a third of a [`linearize`](Self::linearize).
    pub fn renew_gradient(&mut self, x: &[f64]) -> bool {
        if !self.model.is_factored() {
            return false;
        }
        let renewed = self.terms.iter_mut().map(|term| term.renew(x));
        if renewed.fold(false, |any, is_renewed| any | is_renewed) {
            self.renew_pattern();
            return false;
        }
        self.model.clear_gradient();
        for (term, slots) in all(&self.terms, self.constraints.as_ref()).zip(&self.slots) {
            self.model.add_gradient(term, slots, x);
        }
        true
    }

    /// Computes the Newton step of the last gradient plus the response of all vertices to the moves of the fixed ones
    /// in `direction`, both with the last factorization. Returns the norm of the right-hand side.
    ///
    /// Cost: one solve.
    pub fn step_and_follow(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.model.step_and_follow(direction)
    }

    /// Returns the number of factorizations, failed attempts included.
    pub fn factorizations(&self) -> usize {
        self.model.factorizations()
    }

    /// Rebuilds the pattern from the terms' stencils.
    pub(super) fn renew_pattern(&mut self) {
        let (pattern, slots) = pattern(self.n() / self.dim(), self.all());
        self.model.exchange_pattern(pattern);
        self.slots = slots;
    }

    /// Adds `shift` to every diagonal entry of the last [`linearize`](Self::linearize).
    pub fn shift_diagonal(&mut self, shift: f64) {
        self.model.shift_diagonal(shift);
    }

    /// Returns the sum of the shifts since the last [`linearize`](Self::linearize), its own regularization included.
    pub fn shift(&self) -> f64 {
        self.model.shift()
    }

    /// Returns ∂E/∂x at the last [`linearize`](Self::linearize); 0 at fixed vertices.
    pub fn gradient(&self) -> &[f64] {
        self.model.gradient()
    }

    /// Returns the pattern and the lower triangle of the Hessian at the last [`linearize`](Self::linearize), shifted.
    pub fn hessian(&self) -> (&BlockPattern, &[f64]) {
        (self.model.pattern(), self.model.hessian())
    }

    /// Analyzes the pattern and allocates all memory for factoring and solving ahead of the first factorization.
    pub fn prepare(&mut self) {
        self.model.prepare();
    }

    /// Factors the Hessian of the last [`linearize`](Self::linearize); the factor stays until the next one.
    pub fn factor(&mut self) -> Result<(), NotPositiveDefinite> {
        self.model.factor()
    }

    /// Returns whether a factorization outlives later linearizations; `false` if none fits into memory.
    pub fn keeps_factor(&mut self) -> bool {
        self.model.keeps_factor()
    }

    /// Multiplies a vector by the inverse of the matrix that was factored last. If no factor fits into memory, solves
    /// with the present Hessian instead, which fails if that is not positive definite.
    pub fn precondition(&mut self, vector: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        self.model.solve(vector)
    }

    /// Computes the product of the Hessian of the last [`linearize`](Self::linearize) with `vector`.
    pub fn apply_hessian(&self, vector: &[f64], product: &mut [f64]) {
        self.model.apply(vector, product);
    }

    /// Returns d·Hd of the last [`linearize`](Self::linearize).
    pub fn curvature(&self, direction: &[f64]) -> f64 {
        self.model.curvature(direction)
    }

    /// Solves Hd = −g of the last [`linearize`](Self::linearize) and returns the Newton decrement −½g·d, positive.
    ///
    /// Cost: one factorization, one solve.
    pub fn newton_direction(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.model.newton_direction(direction)
    }

    /// Computes the first-order response of all vertices to moves of the fixed ones and of the constraints' targets.
    /// `direction` holds the moves of the fixed vertices and receives the moves of all. Uses the factorization of the
    /// last [`newton_direction`](Self::newton_direction).
    ///
    /// Cost: one solve.
    pub fn follow(
        &mut self,
        direction: &mut [f64],
        target_moves: &[f64],
    ) -> Result<(), NotPositiveDefinite> {
        let constraints = self.constraints.as_ref();
        self.model.follow(direction, |pull| {
            if let Some(constraints) = constraints {
                constraints.add_pull(target_moves, pull);
            }
        })
    }

    /// Returns the change of the energy along a direction predicted by the quadratic model of the last
    /// [`linearize`](Self::linearize): g·d + ½d·Hd. The direction may move the fixed vertices too.
    pub fn model_change(&self, direction: &[f64]) -> f64 {
        self.model.change(direction)
    }

    /// Returns the mean diagonal of the energy's Hessian at the last [`linearize`](Self::linearize), without the
    /// constraints.
    pub fn mean_diagonal(&self) -> f64 {
        self.model.mean_diagonal()
    }

    /// Returns the cost of one factorization; `None` if it needs more memory than [`MOST_BYTES`] and conjugate
    /// gradients take its place.
    ///
    /// [`MOST_BYTES`]: crate::numerics::linear_solver::MOST_BYTES
    pub fn work(&self) -> Option<Work> {
        self.model.work()
    }

    /// Returns the number of symbolic analyses: one, unless a term [renews](crate::energy::Term::renew) its stencils.
    pub fn analyses(&self) -> usize {
        self.model.analyses()
    }
}
