//! One triangle or tetrahedron: from vertex positions to its Jacobian, and from derivatives in J back to the vertices.

use super::modes::Modes;
use super::rest::RestShape;
use super::term::Assembly;
use crate::numerics::square::{Matrix, Square, apply, apply_transposed, times, transposed};
use crate::numerics::svd::Svd;

/// An element in the form that sums over a mesh need. Its vertices are in increasing order, so that the blocks of its
/// Hessian lie in the lower triangle of the matrix. Its orientation is in the order of `gradients`.
#[derive(Clone, Copy, Debug)]
pub struct Simplex<const D: usize> {
    first: u32,
    others: [u32; D],
    /// Gradients of the barycentric coordinates of the other vertices.
    gradients: Matrix<D>,
    /// Determinant of the gradients: one over the determinant of the rest edges, with the sign of the reordering.
    orientation: f64,
    pub size: f64,
    pub weight: f64,
    /// Lower bound of det J.
    pub floor: f64,
}

/// Gradient and Hessian of one element's energy, to be distributed to the vertices.
pub struct Pulled<'a, const D: usize> {
    simplex: &'a Simplex<D>,
    modes: Modes<D>,
    u: Matrix<D>,
    u_transposed: Matrix<D>,
    /// Gradients of the barycentric coordinates in the frame of V.
    framed: Matrix<D>,
}

impl<const D: usize> Simplex<D>
where
    Matrix<D>: Square<D>,
{
    /// Creates the element with D + 1 vertices `first` and `others`, in the order of its rest shape.
    pub fn new(first: u32, others: [u32; D], rest: &RestShape<D>, floor: f64) -> Self {
        let mut opposite = [0.0; D];
        for gradient in &rest.inverse {
            for (sum, g) in opposite.iter_mut().zip(gradient) {
                *sum -= g;
            }
        }
        let mut simplex = Self {
            first,
            others,
            gradients: rest.inverse,
            orientation: 0.0,
            size: rest.size,
            weight: rest.weight,
            floor,
        };
        if let Some(k) = (0..D)
            .filter(|&k| others[k] < first)
            .min_by_key(|&k| others[k])
        {
            std::mem::swap(&mut simplex.first, &mut simplex.others[k]);
            simplex.gradients[k] = opposite;
        }
        let mut order: [usize; D] = std::array::from_fn(|k| k);
        order.sort_unstable_by_key(|&k| simplex.others[k]);
        simplex.others = order.map(|k| simplex.others[k]);
        simplex.gradients = order.map(|k| simplex.gradients[k]);
        simplex.orientation = simplex.gradients.det();
        simplex
    }

    /// Returns the vertices in increasing order.
    pub fn vertices(&self) -> impl Iterator<Item = u32> {
        std::iter::once(self.first).chain(self.others)
    }

    fn edges(&self, x: &[f64]) -> Matrix<D> {
        let position = |v: u32| -> [f64; D] { std::array::from_fn(|k| x[D * v as usize + k]) };
        let origin = position(self.first);
        self.others.map(|v| {
            let p = position(v);
            std::array::from_fn(|k| p[k] - origin[k])
        })
    }

    /// Returns det J: the present size over the rest size, signed.
    pub fn det(&self, x: &[f64]) -> f64 {
        self.edges(x).det() * self.orientation
    }

    /// Returns J and its determinant; computed from the edges it has a smaller rounding error than from J.
    pub fn jacobian(&self, x: &[f64]) -> (Matrix<D>, f64) {
        let edges = self.edges(x);
        (
            times(&transposed(&edges), &self.gradients),
            edges.det() * self.orientation,
        )
    }

    /// Returns the coefficients of det J(x + t d) − floor in powers of t.
    pub fn margin_polynomial(&self, x: &[f64], d: &[f64]) -> [f64; 4] {
        let mut margin = self
            .edges(x)
            .det_along(&self.edges(d))
            .map(|c| c * self.orientation);
        margin[0] -= self.floor;
        margin
    }

    /// Prepares derivatives in J for the vertices and multiplies the negative eigenvalues of the Hessian by `tau`.
    pub fn pull(&self, modes: Modes<D>, svd: &Svd<D>, tau: f64) -> Pulled<'_, D> {
        Pulled {
            simplex: self,
            modes: modes.project(tau),
            u: svd.u,
            u_transposed: transposed(&svd.u),
            framed: self.gradients.map(|g| apply_transposed(&svd.v, &g)),
        }
    }
}

impl<const D: usize> Pulled<'_, D> {
    /// Calls `add` with each vertex and its gradient.
    pub fn gradients(&self, mut add: impl FnMut(u32, [f64; D])) {
        let mut first = [0.0; D];
        for (&vertex, g) in self.simplex.others.iter().zip(&self.framed) {
            let scaled = std::array::from_fn(|k| self.modes.slope[k] * g[k]);
            let gradient = apply(&self.u, &scaled);
            for (sum, g) in first.iter_mut().zip(gradient) {
                *sum -= g;
            }
            add(vertex, gradient);
        }
        add(self.simplex.first, first);
    }

    /// Returns the block of the `k`-th and `l`-th of the other vertices, rows those of the `k`-th.
    fn block(&self, k: usize, l: usize) -> Matrix<D> {
        let framed = self.modes.block(&self.framed[k], &self.framed[l]);
        times(&times(&self.u, &framed), &self.u_transposed)
    }

    /// Adds the Hessian's blocks of every vertex and pair of vertices.
    ///
    /// The blocks of the first vertex follow from the others, because a common translation changes nothing.
    pub fn add_blocks(&self, stencil: usize, assembly: &mut Assembly) {
        // Row sums: minus the blocks of each of the other vertices with the first.
        let mut sums = [[[0.0; D]; D]; D];
        for k in 0..D {
            for l in 0..k {
                let block = self.block(k, l);
                add_to(&mut sums[k], &block);
                add_to(&mut sums[l], &transposed(&block));
                assembly.add_pair(stencil, k * (k + 1) / 2 + l + 1, &block);
            }
            let block = self.block(k, k);
            add_to(&mut sums[k], &block);
            assembly.add_diagonal(self.simplex.others[k], &block);
        }
        let mut first = [[0.0; D]; D];
        for (k, sum) in sums.iter().enumerate() {
            add_to(&mut first, sum);
            let negative = sum.map(|row| row.map(|x| -x));
            assembly.add_pair(stencil, k * (k + 1) / 2, &negative);
        }
        assembly.add_diagonal(self.simplex.first, &first);
    }
}

fn add_to<const D: usize>(sum: &mut Matrix<D>, share: &Matrix<D>) {
    for (sum, share) in sum.as_flattened_mut().iter_mut().zip(share.as_flattened()) {
        *sum += share;
    }
}
