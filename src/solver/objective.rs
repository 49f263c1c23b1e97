//! The function to minimize, with the memory that minimizing it takes.

use super::quadratic_model::QuadraticModel;
use super::settings::Summary;
use super::watch::{Control, Iterate, Taken, Watch};
use crate::energy::{Positional, Term};
use crate::numerics::block::{BlockPattern, Slots};
use crate::numerics::cholesky::{NotPositiveDefinite, Work};

/// A sum of [`Term`]s with its gradient, Hessian and factorization; the pattern is analyzed once, when a factorization is first
/// wanted.
pub struct Objective {
    terms: Vec<Box<dyn Term>>,
    constraints: Option<Positional>,
    /// Of each term, and of the constraints last.
    slots: Vec<Slots>,
    model: QuadraticModel,
    /// Energies far below the sum of the weights are rounding.
    scale: f64,
}

/// An energy below this share of the sum of the weights counts as that much when convergence is judged, so that a
/// surface that can be flattened exactly, whose energy tends to zero, converges too.
const NEGLIGIBLE: f64 = 1e-7;

impl Objective {
    /// `term` as a function of the positions of `n_vertices` vertices.
    ///
    /// # Panics
    /// If a stencil names a vertex that there is not.
    pub fn new(n_vertices: usize, term: Box<dyn Term>) -> Self {
        Self::of_terms(n_vertices, vec![term])
    }

    /// The sum of `terms`, at least one, of equal dimension.
    ///
    /// # Panics
    /// If there is none, if their dimensions differ, or if a stencil names a vertex that there is not.
    pub fn of_terms(n_vertices: usize, terms: Vec<Box<dyn Term>>) -> Self {
        Self::assembled(n_vertices, terms, None)
    }

    /// The sum of `terms` and of soft constraints, whose strength and targets may change.
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
        let dim = terms[0].dim();
        let all = terms.iter().map(AsRef::as_ref);
        let all = all.chain(constraints.iter().map(|c| c as &dyn Term));
        let stencils: Vec<_> = all
            .map(|term| {
                assert_eq!(term.dim(), dim, "terms of one dimension");
                term.stencils()
            })
            .collect();
        let (pattern, slots) = BlockPattern::new(dim, n_vertices, &stencils);
        Self {
            model: QuadraticModel::new(pattern),
            scale: terms.iter().map(|term| term.scale()).sum(),
            slots,
            terms,
            constraints,
        }
    }

    /// Holds these vertices, and only these, where they are.
    pub fn fix(&mut self, vertices: &[u32]) {
        self.model.hold(vertices);
    }

    /// Exchanges the terms for others with the same stencils, as where a parameter of an energy changes; the analysis stays.
    ///
    /// # Panics
    /// If a stencil differs.
    pub fn exchange(&mut self, terms: Vec<Box<dyn Term>>) {
        let stencils = |terms: &[Box<dyn Term>]| -> Vec<_> {
            terms.iter().map(|term| term.stencils()).collect()
        };
        assert!(
            stencils(&terms) == stencils(&self.terms),
            "terms with the same stencils"
        );
        self.scale = terms.iter().map(|term| term.scale()).sum();
        self.terms = terms;
    }

    /// Number of unknowns.
    pub fn n(&self) -> usize {
        self.model.gradient().len()
    }

    /// Coordinates per vertex.
    pub fn dim(&self) -> usize {
        self.model.pattern().dim()
    }

    fn all(&self) -> impl Iterator<Item = &dyn Term> {
        let constraints = self.constraints.iter().map(|c| c as &dyn Term);
        self.terms.iter().map(AsRef::as_ref).chain(constraints)
    }

    /// The soft constraints.
    pub fn constraints(&self) -> Option<&Positional> {
        self.constraints.as_ref()
    }

    /// Changes strength and targets of the soft constraints.
    pub fn set_constraints(&mut self, alpha: f64, targets: &[f64]) {
        if let Some(constraints) = &mut self.constraints {
            constraints.alpha = alpha;
            constraints.targets.copy_from_slice(targets);
        }
    }

    /// Energy and constraints, +∞ outside the domain.
    pub fn value(&self, x: &[f64]) -> f64 {
        self.all().map(|term| term.value(x)).sum()
    }

    /// The energy without the constraints.
    pub fn energy(&self, x: &[f64]) -> f64 {
        self.terms.iter().map(|term| term.value(x)).sum()
    }

    /// The smallest t > 0 at which `x + t·direction` leaves the domain, +∞ if it never does.
    pub fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64 {
        let steps = self
            .terms
            .iter()
            .map(|term| term.largest_step(x, direction));
        steps.fold(f64::INFINITY, f64::min)
    }

    /// The smallest size of an element over its rest size.
    pub fn smallest(&self, x: &[f64]) -> f64 {
        let sizes = self.terms.iter().map(|term| term.smallest(x));
        sizes.fold(f64::INFINITY, f64::min)
    }

    /// Does the domain exclude every inverted element?
    pub fn forbids_flips(&self) -> bool {
        self.terms.iter().any(|term| term.forbids_flips())
    }

    /// Where a minimization stands.
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

    /// Shows an iterate to who watches.
    pub(super) fn show(
        &self,
        x: &[f64],
        summary: &Summary,
        taken: Taken,
        watch: &dyn Watch,
    ) -> Control {
        watch.positions(x);
        watch.iterate(&self.iterate(x, summary, taken))
    }

    /// What a change of energy is compared with: the energy, unless that is negligible.
    pub fn reference(&self, energy: f64) -> f64 {
        energy.abs().max(NEGLIGIBLE * self.scale)
    }

    /// Evaluates gradient and Hessian at `x`, negative eigenvalues of each summand's share times `tau`.
    pub fn linearize(&mut self, x: &[f64], tau: f64) {
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
    pub fn follow(&mut self, direction: &mut [f64], target_moves: &[f64]) {
        let constraints = self.constraints.as_ref();
        self.model.follow(direction, |pull| {
            if let Some(constraints) = constraints {
                constraints.add_pull(target_moves, pull);
            }
        });
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

    /// The sum of the weights.
    pub fn scale(&self) -> f64 {
        self.scale
    }
}
