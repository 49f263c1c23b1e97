//! The function to minimize, with the workspace of its minimization.

use super::quadratic_model::{QuadraticModel, RigidMotions};
use super::settings::{Control, Iterate, Summary, Taken, Watch};
use crate::energy::{Positional, Term};
use crate::numerics::block::{BlockPattern, Slots};
use crate::numerics::cholesky::{NotPositiveDefinite, Work};

/// A sum of [`Term`]s with its gradient, Hessian and factorization. The pattern is analyzed before the first
/// factorization, and again only where a term [renews](Term::renew) its stencils.
pub struct Objective {
    terms: Vec<Box<dyn Term>>,
    constraints: Option<Positional>,
    /// Slots of each term, those of the constraints last.
    slots: Vec<Slots>,
    model: QuadraticModel,
    /// Sum of the weights: energies far below it are rounding.
    scale: f64,
}

/// Smallest reference energy, as a share of the sum of the weights, when convergence is judged: a surface that can be
/// flattened exactly, whose energy tends to zero, converges too.
const NEGLIGIBLE: f64 = 1e-7;

impl Objective {
    /// Creates the objective `term` of the positions of `n_vertices` vertices.
    ///
    /// # Panics
    /// If a stencil names a vertex that does not exist.
    pub fn new(n_vertices: usize, term: Box<dyn Term>) -> Self {
        Self::of_terms(n_vertices, vec![term])
    }

    /// Creates the sum of `terms`, at least one, of equal dimension.
    ///
    /// # Panics
    /// If there are no terms, if their dimensions differ, or if a stencil names a vertex that does not exist.
    pub fn of_terms(n_vertices: usize, terms: Vec<Box<dyn Term>>) -> Self {
        Self::assembled(n_vertices, terms, None)
    }

    /// Creates the sum of `terms` and of soft constraints, whose strength and targets may change.
    ///
    /// # Panics
    /// As [`of_terms`](Self::of_terms).
    pub fn constrained(
        n_vertices: usize,
        terms: Vec<Box<dyn Term>>,
        constraints: Positional,
    ) -> Self {
        Self::assembled(n_vertices, terms, Some(constraints))
    }

    fn assembled(
        n_vertices: usize,
        terms: Vec<Box<dyn Term>>,
        constraints: Option<Positional>,
    ) -> Self {
        let (pattern, slots) = pattern(n_vertices, all(&terms, constraints.as_ref()));
        Self {
            model: QuadraticModel::new(pattern),
            scale: terms.iter().map(|term| term.scale()).sum(),
            slots,
            terms,
            constraints,
        }
    }

    /// Fixes these vertices, and no others, in place.
    pub fn fix(&mut self, vertices: &[u32]) {
        self.model.hold(vertices);
    }

    /// Sets which rigid motions the fixed vertices leave; free ones unless set. Where they leave none, the Hessian is not
    /// regularized unless a factorization fails, and thin bodies converge as fast as others.
    pub fn set_rigid_motions(&mut self, motions: RigidMotions) {
        self.model.set_rigid_motions(motions);
    }

    /// Regularizes the Hessian of the next [`linearize`](Self::linearize) more than that of the last one; returns
    /// `false` if it is so already.
    pub(super) fn regularize(&mut self) -> bool {
        self.model.regularize()
    }

    /// Pulls at these points and no others. If each lies within one element, its pairs of vertices are in the pattern
    /// already, and the analysis stays valid.
    ///
    /// # Panics
    /// If a row names a vertex that does not exist.
    pub fn pull_at(&mut self, points: Positional) {
        let slots = self.model.pattern().slots(&points.stencils());
        self.constraints = Some(points);
        self.slots.truncate(self.terms.len());
        if let Some(slots) = slots {
            self.slots.push(slots);
        } else {
            self.renew_pattern();
        }
    }

    /// Exchanges the terms for others, as when a parameter of an energy changes. If their stencils are the same, the
    /// analysis stays valid.
    pub fn exchange(&mut self, terms: Vec<Box<dyn Term>>) {
        let stencils = |terms: &[Box<dyn Term>]| -> Vec<_> {
            terms.iter().map(|term| term.stencils()).collect()
        };
        let is_same = stencils(&terms) == stencils(&self.terms);
        self.scale = terms.iter().map(|term| term.scale()).sum();
        self.terms = terms;
        if !is_same {
            self.renew_pattern();
        }
    }

    /// Returns the number of unknowns.
    pub fn n(&self) -> usize {
        self.model.gradient().len()
    }

    /// Returns the number of coordinates per vertex.
    pub fn dim(&self) -> usize {
        self.model.pattern().dim()
    }

    fn all(&self) -> impl Iterator<Item = &dyn Term> {
        all(&self.terms, self.constraints.as_ref())
    }

    /// Returns the soft constraints.
    pub fn constraints(&self) -> Option<&Positional> {
        self.constraints.as_ref()
    }

    /// Sets strength and targets of the soft constraints.
    pub fn set_constraints(&mut self, alpha: f64, targets: &[f64]) {
        if let Some(constraints) = &mut self.constraints {
            constraints.alpha = alpha;
            constraints.targets.copy_from_slice(targets);
        }
    }

    /// Returns energy plus constraints, +∞ outside the domain.
    pub fn value(&self, x: &[f64]) -> f64 {
        self.all().map(|term| term.value(x)).sum()
    }

    /// Returns the energy without the constraints.
    pub fn energy(&self, x: &[f64]) -> f64 {
        self.terms.iter().map(|term| term.value(x)).sum()
    }

    /// Returns the smallest t > 0 at which `x + t·direction` leaves the domain, +∞ if it never does.
    pub fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64 {
        let steps = self
            .terms
            .iter()
            .map(|term| term.largest_step(x, direction));
        steps.fold(f64::INFINITY, f64::min)
    }

    /// Returns the smallest ratio of an element's size to its rest size.
    pub fn smallest(&self, x: &[f64]) -> f64 {
        let sizes = self.terms.iter().map(|term| term.smallest(x));
        sizes.fold(f64::INFINITY, f64::min)
    }

    /// Returns whether the domain excludes every inverted element.
    pub fn forbids_flips(&self) -> bool {
        self.terms.iter().any(|term| term.forbids_flips())
    }

    /// Returns the report of an iterate for watchers.
    pub(super) fn iterate(&self, x: &[f64], summary: &Summary, taken: Taken) -> Iterate {
        let constraints = self.constraints.as_ref();
        let iterate = Iterate {
            iteration: summary.iterations,
            energy: constraints.map_or(summary.energy_last, |_| self.energy(x)),
            barrier: self.terms.iter().map(|term| term.barrier(x)).sum(),
            constraint: constraints.map_or(0.0, |c| c.value(x)),
            smallest: self.smallest(x),
            mu: taken.mu,
            sigma: taken.sigma,
            alpha: constraints.map_or(0.0, |c| c.alpha),
            residual: constraints.map_or(0.0, |c| c.residual(x, &c.targets)),
        };
        debug_assert!(iterate.smallest > 0.0 || !self.forbids_flips());
        iterate
    }

    /// Shows an iterate to the watcher and returns its decision.
    pub(super) fn show(
        &self,
        x: &[f64],
        summary: &Summary,
        taken: Taken,
        watch: &dyn Watch,
    ) -> Control {
        let iterate = self.iterate(x, summary, taken);
        watch.positions(&iterate, x);
        watch.iterate(&iterate)
    }

    /// Returns the energy that a change is compared with: `energy`, unless that is negligible.
    pub fn reference(&self, energy: f64) -> f64 {
        energy.abs().max(NEGLIGIBLE * self.scale)
    }

    /// Returns the sum of the weights.
    pub fn scale(&self) -> f64 {
        self.scale
    }
}

/// Iterates over the terms, the constraints last.
fn all<'a>(
    terms: &'a [Box<dyn Term>],
    constraints: Option<&'a Positional>,
) -> impl Iterator<Item = &'a dyn Term> {
    let constraints = constraints.map(|c| c as &dyn Term);
    terms.iter().map(AsRef::as_ref).chain(constraints)
}

/// Returns the pattern of a sum of terms of one dimension, and the slots of each.
fn pattern<'a>(
    n_vertices: usize,
    terms: impl Iterator<Item = &'a dyn Term>,
) -> (BlockPattern, Vec<Slots>) {
    let (dims, stencils): (Vec<_>, Vec<_>) =
        terms.map(|term| (term.dim(), term.stencils())).unzip();
    assert!(
        dims.iter().all(|dim| *dim == dims[0]),
        "terms of one dimension"
    );
    BlockPattern::new(dims[0], n_vertices, &stencils)
}

// The quadratic model of the function at a point: gradient, Hessian and solutions of systems with it.

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
    fn renew_pattern(&mut self) {
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
