//! The function to minimize, with the memory that minimizing it takes.

use crate::energy::Term;
use crate::numerics::block::BlockPattern;
use crate::numerics::cholesky::{Cholesky, NotPositiveDefinite};

/// A [`Term`] with its gradient, Hessian and factorization; the pattern is analyzed once, when this is made.
pub struct Objective {
    term: Box<dyn Term>,
    pattern: BlockPattern,
    cholesky: Cholesky,
    gradient: Vec<f64>,
    hessian: Vec<f64>,
    /// Energies far below the sum of the weights are rounding.
    scale: f64,
    fixed: Vec<u32>,
    fixed_slots: Vec<usize>,
}

/// Diagonal shift, as a share of the mean diagonal: makes the rigid motions, which nothing holds, regular.
const SHIFT: f64 = 1e-7;

/// An energy below this share of the sum of the weights counts as that much when convergence is judged, so that a
/// surface that can be flattened exactly, whose energy tends to zero, converges too.
const NEGLIGIBLE: f64 = 1e-7;

impl Objective {
    /// `term` as a function of the positions of `n_vertices` vertices.
    ///
    /// # Panics
    /// If the term's triangles name a vertex that there is not.
    pub fn new(n_vertices: usize, term: Box<dyn Term>) -> Self {
        let pattern = BlockPattern::new(n_vertices, term.stencils().into_iter());
        Self {
            cholesky: Cholesky::analyze(pattern.scalar()),
            gradient: vec![0.0; pattern.scalar().n],
            hessian: vec![0.0; pattern.scalar().row_idx.len()],
            scale: term.scale(),
            fixed: Vec::new(),
            fixed_slots: Vec::new(),
            pattern,
            term,
        }
    }

    /// Holds these vertices, and only these, where they are.
    pub fn fix(&mut self, vertices: &[u32]) {
        let mut chosen = vec![false; self.n() / 2];
        for &v in vertices {
            chosen[v as usize] = true;
        }
        self.fixed = vertices.to_vec();
        self.fixed_slots = self.pattern.rows_and_columns(&chosen);
    }

    /// Number of unknowns.
    pub fn n(&self) -> usize {
        self.gradient.len()
    }

    /// The energy's terms, without what is fixed.
    pub fn term(&self) -> &dyn Term {
        &*self.term
    }

    /// The energy, +∞ outside the domain.
    pub fn value(&self, x: &[f64]) -> f64 {
        self.term.value(x)
    }

    /// What a change of energy is compared with: the energy, unless that is negligible.
    pub fn reference(&self, energy: f64) -> f64 {
        energy.max(NEGLIGIBLE * self.scale)
    }

    /// Evaluates gradient and Hessian at `x`, negative eigenvalues of each triangle's share times `tau`.
    pub fn linearize(&mut self, x: &[f64], tau: f64) {
        self.gradient.fill(0.0);
        self.hessian.fill(0.0);
        self.term
            .add_derivatives(x, tau, &self.pattern, &mut self.gradient, &mut self.hessian);
        let diagonal = self.pattern.diagonal();
        let sum: f64 = diagonal.iter().map(|&slot| self.hessian[slot]).sum();
        let mean = sum / diagonal.len().max(1) as f64;
        for &slot in diagonal {
            self.hessian[slot] += SHIFT * mean + f64::MIN_POSITIVE;
        }
        self.hold_fixed(mean);
    }

    /// Makes rows and columns of the fixed vertices those of a multiple of the identity.
    fn hold_fixed(&mut self, diagonal: f64) {
        for &slot in &self.fixed_slots {
            self.hessian[slot] = 0.0;
        }
        for &v in &self.fixed {
            for i in [2 * v as usize, 2 * v as usize + 1] {
                self.hessian[self.pattern.diagonal()[i]] = diagonal;
                self.gradient[i] = 0.0;
            }
        }
    }

    /// ∂E/∂x at the last [`linearize`](Self::linearize); 0 at fixed vertices.
    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    /// The Hessian's lower triangle at the last [`linearize`](Self::linearize), shifted, and its pattern.
    pub fn hessian(&self) -> (&BlockPattern, &[f64]) {
        (&self.pattern, &self.hessian)
    }

    /// Solves Hd = −g of the last [`linearize`](Self::linearize) and returns the Newton decrement −½g·d, positive.
    ///
    /// Cost: one factorization, one solve.
    pub fn newton_direction(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.cholesky.factor(&self.hessian)?;
        for (d, g) in direction.iter_mut().zip(&self.gradient) {
            *d = -g;
        }
        self.cholesky.solve(direction, 1);
        let slope: f64 = direction
            .iter()
            .zip(&self.gradient)
            .map(|(d, g)| d * g)
            .sum();
        if slope <= 0.0 {
            Ok(-0.5 * slope)
        } else {
            Err(NotPositiveDefinite)
        }
    }
}
