//! What the solver asks of an energy.

use crate::numerics::block::{BlockPattern, Slots};
use crate::numerics::square::Matrix;
use crate::numerics::stencils::Stencils;

/// A sum of functions of a few vertices' positions each.
///
/// Positions `x` are flat: with D coordinates per vertex, those of vertex `v` are `x[Dv..Dv + D]`. All sums run in the order
/// of the stencils, so results depend on the arguments alone. Of the methods with a default the defaults are those of a
/// term that is finite everywhere.
pub trait Term: Send + Sync {
    /// D: coordinates per vertex, 2 or 3.
    fn dim(&self) -> usize;

    /// The vertices of each summand, the same at all times but as [`renew`](Self::renew) says.
    fn stencils(&self) -> Stencils;

    /// Takes note of where derivatives are wanted next; true if its stencils are now others than before.
    fn renew(&mut self, _x: &[f64]) -> bool {
        false
    }

    /// The value that counts as large, such as the sum of the weights: an energy far below it is rounding.
    fn scale(&self) -> f64 {
        0.0
    }

    /// The sum, +∞ as soon as one summand is outside its domain.
    fn value(&self, x: &[f64]) -> f64;

    /// Adds gradient and Hessian at `x`, with negative eigenvalues of each summand's Hessian multiplied by `tau`: at 0 it
    /// must be positive semidefinite, at 1 the true one.
    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly);

    /// The smallest t > 0 at which `x + t·direction` leaves the domain, +∞ if it never does.
    fn largest_step(&self, _x: &[f64], _direction: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// The smallest det J: the smallest size of an element over its rest size, negative where one is inverted; +∞ if the
    /// term has no elements.
    fn smallest(&self, _x: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// The share of the value that is there only to keep the map valid.
    fn barrier(&self, _x: &[f64]) -> f64 {
        0.0
    }

    /// Does the domain exclude every inverted element?
    fn forbids_flips(&self) -> bool {
        false
    }
}

/// Where a term adds its gradient and Hessian.
pub struct Assembly<'a> {
    pattern: &'a BlockPattern,
    slots: &'a Slots,
    gradient: &'a mut [f64],
    hessian: &'a mut [f64],
    wants_hessian: bool,
}

impl<'a> Assembly<'a> {
    /// Sums into `gradient` and the values of `pattern`, in the term's `slots`.
    pub fn new(
        pattern: &'a BlockPattern,
        slots: &'a Slots,
        gradient: &'a mut [f64],
        hessian: &'a mut [f64],
    ) -> Self {
        Self {
            pattern,
            slots,
            gradient,
            hessian,
            wants_hessian: true,
        }
    }

    /// Sums into `gradient` alone: what is added to the Hessian is dropped, and need not be found.
    pub fn of_gradient(
        pattern: &'a BlockPattern,
        slots: &'a Slots,
        gradient: &'a mut [f64],
    ) -> Self {
        Self {
            pattern,
            slots,
            gradient,
            hessian: &mut [],
            wants_hessian: false,
        }
    }

    /// Is there a Hessian to add to?
    pub fn wants_hessian(&self) -> bool {
        self.wants_hessian
    }

    /// Adds to the gradient at a vertex.
    pub fn add_gradient<const D: usize>(&mut self, vertex: u32, gradient: &[f64; D]) {
        let at = D * vertex as usize;
        for (sum, share) in self.gradient[at..at + D].iter_mut().zip(gradient) {
            *sum += share;
        }
    }

    /// Adds to the gradient in one unknown.
    pub fn add_to_gradient(&mut self, unknown: usize, share: f64) {
        self.gradient[unknown] += share;
    }

    /// Adds a multiple of the identity to the block of one vertex.
    pub fn add_diagonal_identity(&mut self, vertex: u32, share: f64) {
        if self.wants_hessian {
            self.pattern
                .add_diagonal_identity(self.hessian, vertex, share);
        }
    }

    /// Adds a multiple of the identity to the block of two vertices of a stencil; `pair` counts them as
    /// [`Stencils::pairs`] does.
    pub fn add_pair_identity(&mut self, stencil: usize, pair: usize, share: f64) {
        if self.wants_hessian {
            let slot = self.slots.of(stencil)[pair];
            self.pattern.add_pair_identity(self.hessian, slot, share);
        }
    }

    /// Adds to the block of one vertex; the lower triangle of `block` is read.
    pub fn add_diagonal<const D: usize>(&mut self, vertex: u32, block: &Matrix<D>) {
        if self.wants_hessian {
            self.pattern.add_diagonal(self.hessian, vertex, block);
        }
    }

    /// Adds to the block of two vertices of a stencil, its rows those of the larger; `pair` counts them as
    /// [`Stencils::pairs`] does.
    pub fn add_pair<const D: usize>(&mut self, stencil: usize, pair: usize, block: &Matrix<D>) {
        if self.wants_hessian {
            BlockPattern::add_pair(self.hessian, self.slots.of(stencil)[pair], block);
        }
    }
}
