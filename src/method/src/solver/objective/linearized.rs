//! The function as it looks from a point: its gradient, its Hessian and what is solved with that.

use super::{Objective, all, pattern};
use crate::numerics::block::BlockPattern;
use crate::numerics::cholesky::{NotPositiveDefinite, Work};

impl Objective {
    /// Evaluates gradient and Hessian at `x`, negative eigenvalues of each summand's share times `tau`.
    pub fn linearize(&mut self, x: &[f64], tau: f64) {
        let renewed = self.terms.iter_mut().map(|term| term.renew(x));
        if renewed.fold(false, |any, is_renewed| any | is_renewed) {
            self.renew_pattern();
        }
        self.model.clear();
        for (term, slots) in self.terms.iter().zip(&self.slots) {
            self.model.add(term.as_ref(), slots, x, tau);
        }
        // Before the constraints: their strength says nothing of the energy's.
        self.model.measure();
        if let (Some(constraints), Some(slots)) = (&self.constraints, self.slots.last()) {
            self.model.add(constraints, slots, x, tau);
        }
        self.model.finish();
    }

    /// Evaluates the gradient alone at `x`; Hessian and factorization stay those of another point. False if there is no
    /// factorization to go with it, as after vertices were fixed, or where a term [renews](crate::energy::Term::renew) its stencils.
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

    /// The Newton step of the last gradient, and how all vertices follow the moves of the fixed ones in `direction`, both with the last
    /// factorization; the norm of the right side.
    ///
    /// Cost: one solve.
    pub fn step_and_follow(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.model.step_and_follow(direction)
    }

    /// How many matrices were factored, failed attempts included.
    pub fn factorizations(&self) -> usize {
        self.model.factorizations()
    }

    /// Takes the pattern from the terms' stencils anew.
    pub(super) fn renew_pattern(&mut self) {
        let (pattern, slots) = pattern(self.n() / self.dim(), self.all());
        self.model.exchange_pattern(pattern);
        self.slots = slots;
    }

    /// Adds to every diagonal entry of the last [`linearize`](Self::linearize).
    pub fn shift_diagonal(&mut self, shift: f64) {
        self.model.shift_diagonal(shift);
    }

    /// What was added to every diagonal entry since.
    pub fn shift(&self) -> f64 {
        self.model.shift()
    }

    /// ∂E/∂x at the last [`linearize`](Self::linearize); 0 at fixed vertices.
    pub fn gradient(&self) -> &[f64] {
        self.model.gradient()
    }

    /// The Hessian's lower triangle at the last [`linearize`](Self::linearize), shifted, and its pattern.
    pub fn hessian(&self) -> (&BlockPattern, &[f64]) {
        (self.model.pattern(), self.model.hessian())
    }

    /// Does the analysis that the first factorization would do, and allocates all that factoring and solving will need.
    pub fn prepare(&mut self) {
        self.model.prepare();
    }

    /// Factors the Hessian of the last [`linearize`](Self::linearize); the factor stays until the next one.
    pub fn factor(&mut self) -> Result<(), NotPositiveDefinite> {
        self.model.factor()
    }

    /// Whether a factorization of one linearization stays while there are others; false where none fits into memory.
    pub fn keeps_factor(&mut self) -> bool {
        self.model.keeps_factor()
    }

    /// Replaces a vector by its product with the inverse of the matrix that was factored last; where none fits into memory, of the
    /// present Hessian, unless that is not positive definite.
    pub fn precondition(&mut self, vector: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        self.model.solve(vector)
    }

    /// The product of the Hessian of the last [`linearize`](Self::linearize) with `vector`.
    pub fn apply_hessian(&self, vector: &[f64], product: &mut [f64]) {
        self.model.apply(vector, product);
    }

    /// d·Hd of the last [`linearize`](Self::linearize).
    pub fn curvature(&self, direction: &[f64]) -> f64 {
        self.model.curvature(direction)
    }

    /// Solves Hd = −g of the last [`linearize`](Self::linearize) and returns the Newton decrement −½g·d, positive.
    ///
    /// Cost: one factorization, one solve.
    pub fn newton_direction(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.model.newton_direction(direction)
    }

    /// How all vertices follow when the fixed ones and the constraints' targets move, to first order: given the move at the
    /// fixed vertices and that of the targets, solves for the others. Uses the factorization of the last
    /// [`newton_direction`](Self::newton_direction).
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

    /// What the quadratic model of the last [`linearize`](Self::linearize) says of the change of the energy along a
    /// direction that may move the fixed vertices too: g·d + ½d·Hd.
    pub fn model_change(&self, direction: &[f64]) -> f64 {
        self.model.change(direction)
    }

    /// The mean diagonal of the energy's Hessian at the last [`linearize`](Self::linearize), the constraints left out.
    pub fn mean_diagonal(&self) -> f64 {
        self.model.mean_diagonal()
    }

    /// What one factorization takes; `None` where that is more memory than [`MOST_BYTES`], and conjugate gradients take its place.
    ///
    /// [`MOST_BYTES`]: crate::numerics::linear_solver::MOST_BYTES
    pub fn work(&self) -> Option<Work> {
        self.model.work()
    }

    /// How often a pattern was ordered and analyzed: once, unless a term [renews](crate::energy::Term::renew) its stencils.
    pub fn analyses(&self) -> usize {
        self.model.analyses()
    }
}
