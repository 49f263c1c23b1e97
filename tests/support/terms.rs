//! Terms on two elements, and the check of their derivatives.

use faer::Mat;
use unwrapd_method::barrier::Barrier;
use unwrapd_method::energy::{Assembly, Density, RestShape, Term, Tetrahedra, Triangles};
use unwrapd_method::numerics::block::BlockPattern;

use crate::taylor::assert_taylor;

/// Two triangles, one of them clockwise in its indices' order, both positive.
pub const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 3]];
pub const PLANE: [f64; 8] = [0.1, 0.0, 0.9, 0.2, 0.2, 0.7, 1.4, 1.6];
pub const PLANE_WAY: [f64; 8] = [0.3, -0.2, 0.15, 0.4, -0.35, 0.2, 0.1, -0.3];

/// Two tetrahedra with a common face, both positive.
pub const TETRAHEDRA: [[u32; 4]; 2] = [[0, 1, 2, 3], [4, 2, 1, 3]];
pub const SPACE: [f64; 15] = [
    0.1, 0.0, -0.1, 0.9, 0.2, 0.1, 0.2, 0.7, 0.05, 0.3, 0.2, 0.8, 1.3, 1.1, 0.4,
];
pub const SPACE_WAY: [f64; 15] = [
    0.3, -0.2, 0.15, 0.4, -0.35, 0.2, 0.1, -0.3, 0.25, -0.15, 0.05, 0.3, -0.2, 0.1, 0.12,
];

pub fn plane_rest() -> [RestShape<2>; 2] {
    [
        RestShape::from_edges([1.1, 0.2], [0.3, 0.9]),
        RestShape::from_edges([0.8, -0.1], [0.2, 1.4]),
    ]
}

pub fn space_rest() -> [RestShape<3>; 2] {
    [
        [
            [0.0, 0.0, 0.0],
            [1.1, 0.1, 0.0],
            [0.2, 0.9, 0.1],
            [0.0, 0.3, 1.2],
        ],
        [
            [1.0, 0.7, 0.1],
            [0.0, 0.0, 0.0],
            [0.6, -0.5, 0.2],
            [0.2, 0.1, 1.0],
        ],
    ]
    .map(RestShape::from_tetrahedron)
}

/// Checks value, gradient and Hessian of a sum over two triangles: the density, the singular vectors and the way back to the
/// vertices at once.
pub fn assert_plane_taylor(density: impl Density<2> + 'static, barrier: Barrier) {
    let term = Triangles::new(&TRIANGLES, &plane_rest(), density, barrier);
    assert_term_taylor(&term, &PLANE, &PLANE_WAY);
}

/// The same for two tetrahedra.
pub fn assert_space_taylor(density: impl Density<3> + 'static, barrier: Barrier) {
    let term = Tetrahedra::new(&TETRAHEDRA, &space_rest(), density, barrier);
    assert_term_taylor(&term, &SPACE, &SPACE_WAY);
}

/// Gradient and Hessian of a term, negative curvature times `tau`.
pub fn derivatives(term: &dyn Term, x: &[f64], tau: f64) -> (Vec<f64>, Mat<f64>) {
    let (pattern, slots) = BlockPattern::new(term.dim(), x.len() / term.dim(), &[term.stencils()]);
    let mut gradient = vec![0.0; x.len()];
    let mut values = vec![0.0; pattern.scalar().row_idx.len()];
    let mut assembly = Assembly::new(&pattern, &slots[0], &mut gradient, &mut values);
    term.add_derivatives(x, tau, &mut assembly);
    (gradient, dense(&pattern, &values))
}

pub fn assert_term_taylor(term: &dyn Term, x: &[f64], d: &[f64]) {
    let (gradient, hessian) = derivatives(term, x, 1.0);
    let times = |v: &[f64]| {
        let row = |i: usize| v.iter().enumerate().map(|(j, v)| hessian[(i, j)] * v).sum();
        (0..v.len()).map(row).collect()
    };
    assert_taylor(|x| term.value(x), &gradient, times, x, d);
}

/// The whole of a symmetric matrix from its lower triangle.
pub fn dense(pattern: &BlockPattern, values: &[f64]) -> Mat<f64> {
    let pattern = pattern.scalar();
    let mut a = Mat::zeros(pattern.n, pattern.n);
    for j in 0..pattern.n {
        let column = pattern.col_ptr[j]..pattern.col_ptr[j + 1];
        for (&i, &value) in pattern.row_idx[column.clone()].iter().zip(&values[column]) {
            a[(i, j)] = value;
            a[(j, i)] = value;
        }
    }
    a
}
