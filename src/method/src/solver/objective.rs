//! The function to minimize, with the workspace of its minimization.

mod linearized;

use super::quadratic_model::QuadraticModel;
use super::settings::Summary;
use super::watch::{Control, Iterate, Taken, Watch};
use crate::energy::{Positional, Term};
use crate::numerics::block::{BlockPattern, Slots};

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

    /// Exchanges the terms for others with the same stencils, as when a parameter of an energy changes; the analysis
    /// stays valid.
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
