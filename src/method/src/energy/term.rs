//! The interface between an energy and the solver.

use crate::numerics::block::{BlockPattern, Slots};
use crate::numerics::square::Matrix;
use crate::numerics::stencils::Stencils;

/// A sum of functions, each of the positions of a few vertices.
///
/// Positions `x` are flat: with D coordinates per vertex, those of vertex `v` are `x[Dv..Dv + D]`. All sums run in the
/// order of the stencils, so results depend on the arguments alone. Default methods are those of a term that is finite
/// everywhere.
pub trait Term: Send + Sync {
    /// Returns D, the number of coordinates per vertex: 2 or 3.
    fn dim(&self) -> usize;

    /// Returns the vertices of each summand; they change only when [`renew`](Self::renew) says so.
    fn stencils(&self) -> Stencils;

    /// Notifies the term of the point at which derivatives are needed next; returns whether its stencils have changed.
    fn renew(&mut self, _x: &[f64]) -> bool {
        false
    }

    /// Returns the value that counts as large, such as the sum of the weights: an energy far below it is rounding.
    fn scale(&self) -> f64 {
        0.0
    }

    /// Returns the sum, +∞ if any summand is outside its domain.
    fn value(&self, x: &[f64]) -> f64;

    /// Adds gradient and Hessian at `x`, with negative eigenvalues of each summand's Hessian multiplied by `tau`: at 0
    /// it must be positive semidefinite, at 1 the true one.
    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly);

    /// Returns the smallest t > 0 at which `x + t·direction` leaves the domain, +∞ if it never does.
    fn largest_step(&self, _x: &[f64], _direction: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// Returns the smallest det J, the ratio of an element's size to its rest size, negative where one is inverted; +∞
    /// if the term has no elements.
    fn smallest(&self, _x: &[f64]) -> f64 {
        f64::INFINITY
    }

    /// Returns the share of the value whose only purpose is to keep the map valid.
    fn barrier(&self, _x: &[f64]) -> f64 {
        0.0
    }

    /// Returns whether the domain excludes every inverted element.
    fn forbids_flips(&self) -> bool {
        false
    }
}

/// Destination of a term's gradient and Hessian.
pub struct Assembly<'a> {
    pattern: &'a BlockPattern,
    slots: &'a Slots,
    gradient: &'a mut [f64],
    hessian: &'a mut [f64],
    wants_hessian: bool,
}

impl<'a> Assembly<'a> {
    /// Creates an assembly that sums into `gradient` and the values of `pattern`, in the term's `slots`.
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

    /// Creates an assembly that sums into `gradient` alone: Hessians are discarded and need not be computed.
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

    /// Returns whether a Hessian is assembled.
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

    /// Adds a multiple of the identity to the block of two vertices of a stencil; `pair` numbers them as
    /// [`Stencils::pairs`] does.
    pub fn add_pair_identity(&mut self, stencil: usize, pair: usize, share: f64) {
        if self.wants_hessian {
            let slot = self.slots.of(stencil)[pair];
            self.pattern.add_pair_identity(self.hessian, slot, share);
        }
    }

    /// Adds to the block of one vertex; only the lower triangle of `block` is read.
    pub fn add_diagonal<const D: usize>(&mut self, vertex: u32, block: &Matrix<D>) {
        if self.wants_hessian {
            self.pattern.add_diagonal(self.hessian, vertex, block);
        }
    }

    /// Adds to the block of two vertices of a stencil, its rows those of the larger; `pair` numbers them as
    /// [`Stencils::pairs`] does.
    pub fn add_pair<const D: usize>(&mut self, stencil: usize, pair: usize, block: &Matrix<D>) {
        if self.wants_hessian {
            BlockPattern::add_pair(self.hessian, self.slots.of(stencil)[pair], block);
        }
    }
}

// Soft positional constraints.

/// A linear function of positions with a target value: vertices, in increasing order, with their weights. For a point
/// in an element these are its barycentric coordinates.
pub type Row = Vec<(u32, f64)>;

/// α‖Cx − t‖² with a sparse C that is the same for each coordinate.
///
/// Minimum 0, where Cx = t. Unit: α times a length squared. Domain: everywhere. From: Schüller et al. 2013, equation 9.
/// Tests: `energy::taylor_positional`.
#[derive(Clone, Debug)]
pub struct Positional {
    /// Coordinates per position.
    pub dim: usize,
    /// The rows of C.
    pub rows: Vec<Row>,
    /// t: a position for each row, coordinates one after another.
    pub targets: Vec<f64>,
    /// α, the strength.
    pub alpha: f64,
}

impl Positional {
    /// Iterates over Cx: the position of each row, coordinates one after another.
    pub fn places<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let rows = self.rows.iter();
        rows.flat_map(move |row| (0..self.dim).map(move |k| self.place(row, k, x)))
    }

    /// Returns coordinate `k` of the position of a row.
    fn place(&self, row: &Row, k: usize, x: &[f64]) -> f64 {
        let weighted = row.iter().map(|&(v, w)| w * x[self.dim * v as usize + k]);
        weighted.sum()
    }

    /// Adds 2αCᵀ·`moves` to `sum`: the growth of the negative gradient when the targets move.
    pub fn add_pull(&self, moves: &[f64], sum: &mut [f64]) {
        for (row, moves) in self.rows.iter().zip(moves.chunks(self.dim)) {
            for &(v, weight) in row {
                for (k, t) in moves.iter().enumerate() {
                    sum[self.dim * v as usize + k] += 2.0 * self.alpha * weight * t;
                }
            }
        }
    }

    /// Returns ‖Cx − d‖² for these positions d.
    pub fn residual(&self, x: &[f64], targets: &[f64]) -> f64 {
        let gaps = self.places(x).zip(targets).map(|(place, t)| place - t);
        gaps.map(|gap| gap * gap).sum()
    }
}

impl Term for Positional {
    fn dim(&self) -> usize {
        self.dim
    }

    fn stencils(&self) -> Stencils {
        let vertices: Vec<Vec<u32>> = (self.rows.iter())
            .map(|row| row.iter().map(|&(v, _)| v).collect())
            .collect();
        Stencils::of(vertices.iter().map(Vec::as_slice))
    }

    fn value(&self, x: &[f64]) -> f64 {
        self.alpha * self.residual(x, &self.targets)
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (index, row) in self.rows.iter().enumerate() {
            for k in 0..self.dim {
                let gap = self.place(row, k, x) - self.targets[self.dim * index + k];
                for &(v, weight) in row {
                    let share = 2.0 * self.alpha * weight * gap;
                    assembly.add_to_gradient(self.dim * v as usize + k, share);
                }
            }
            let mut pair = 0;
            for (j, &(v, weight)) in row.iter().enumerate() {
                let factor = 2.0 * self.alpha * weight;
                assembly.add_diagonal_identity(v, factor * weight);
                for &(_, other) in &row[..j] {
                    assembly.add_pair_identity(index, pair, factor * other);
                    pair += 1;
                }
            }
        }
    }
}
