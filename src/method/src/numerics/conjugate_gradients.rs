//! Symmetric positive definite systems that are too large to factor.

use super::cholesky::{NotPositiveDefinite, SymmetricPattern};

/// Relative residual of the solution, in the norm of the preconditioner: a direction for Newton's method need not be
/// more exact, as its error is of the same order as what the step leaves of the gradient.
const TOLERANCE: f64 = 1e-4;

/// Most iterations; each brings x nearer to the solution, so an early end still gives a useful direction.
const MOST_ITERATIONS: usize = 2_000;

/// Conjugate gradients, preconditioned by a symmetric Gauss–Seidel sweep, M = (L + D) D⁻¹ (L + D)ᵀ.
///
/// Memory: four vectors besides the matrix. Time: three passes over the matrix per iteration; their number grows with
/// the mesh's diameter in elements. Runs on one thread, so that sums have one order. From: Hestenes and Stiefel 1952,
/// Methods of Conjugate Gradients for Solving Linear Systems; Saad 2003, Iterative Methods for Sparse Linear Systems,
/// section 10.2.
pub struct ConjugateGradients {
    residual: Vec<f64>,
    swept: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    tolerance: f64,
}

impl ConjugateGradients {
    /// Allocates the workspace for systems of `n` unknowns.
    pub fn new(n: usize) -> Self {
        Self {
            residual: vec![0.0; n],
            swept: vec![0.0; n],
            direction: vec![0.0; n],
            image: vec![0.0; n],
            tolerance: TOLERANCE,
        }
    }

    /// Sets the relative residual of solutions, in the norm of the preconditioner; 1e-4 unless set.
    #[must_use]
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// Replaces b in `x` by the solution of Ax = b up to the tolerance. A is given by its pattern and the values of its
    /// lower triangle.
    ///
    /// # Errors
    /// If it finds a direction along which A is not positive; `x` is then the last iterate.
    pub fn solve(
        &mut self,
        pattern: &SymmetricPattern,
        values: &[f64],
        x: &mut [f64],
    ) -> Result<(), NotPositiveDefinite> {
        // Start from x = 0, whose residual is b, along the preconditioned residual.
        let matrix = SymmetricMatrix { pattern, values };
        self.residual.copy_from_slice(x);
        x.fill(0.0);
        matrix.sweep(&self.residual, &mut self.swept)?;
        self.direction.copy_from_slice(&self.swept);
        let mut size = dot(&self.residual, &self.swept);
        let enough = self.tolerance * self.tolerance * size;
        for _ in 0..MOST_ITERATIONS {
            if size <= enough {
                break;
            }
            // Go to the lowest point along the direction.
            pattern.multiply(values, &self.direction, &mut self.image);
            let curvature = dot(&self.direction, &self.image);
            if curvature <= 0.0 || curvature.is_nan() {
                return Err(NotPositiveDefinite);
            }
            let step = size / curvature;
            for (x, d) in x.iter_mut().zip(&self.direction) {
                *x += step * d;
            }
            for (r, q) in self.residual.iter_mut().zip(&self.image) {
                *r -= step * q;
            }
            // Turn to the next conjugate direction.
            matrix.sweep(&self.residual, &mut self.swept)?;
            let before = std::mem::replace(&mut size, dot(&self.residual, &self.swept));
            for (d, z) in self.direction.iter_mut().zip(&self.swept) {
                *d = z + size / before * *d;
            }
        }
        Ok(())
    }
}

/// A symmetric matrix, given by its lower triangle.
struct SymmetricMatrix<'a> {
    pattern: &'a SymmetricPattern,
    values: &'a [f64],
}

impl SymmetricMatrix<'_> {
    /// Returns the diagonal entry of a column and the rows and values below it.
    fn column(&self, j: usize) -> (f64, impl Iterator<Item = (usize, f64)>) {
        let slots = self.pattern.col_ptr[j]..self.pattern.col_ptr[j + 1];
        let (rows, values) = (&self.pattern.row_idx[slots.clone()], &self.values[slots]);
        let below = rows[1..].iter().zip(&values[1..]);
        (values[0], below.map(|(&row, &value)| (row, value)))
    }

    /// Solves Mz = r.
    fn sweep(&self, r: &[f64], z: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        z.copy_from_slice(r);
        for j in 0..z.len() {
            let (diagonal, below) = self.column(j);
            if diagonal <= 0.0 || diagonal.is_nan() {
                return Err(NotPositiveDefinite);
            }
            let share = z[j] / diagonal;
            for (i, a) in below {
                z[i] -= a * share;
            }
        }
        for j in (0..z.len()).rev() {
            let (diagonal, below) = self.column(j);
            let sum: f64 = below.map(|(i, a)| a * z[i]).sum();
            z[j] = (z[j] - sum) / diagonal;
        }
        Ok(())
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
