//! Densities: derivatives, projection, minima.

use faer::{Mat, Side};
use proptest::prelude::*;
use unwrapd::barrier::NoBarrier;
use unwrapd::energy::{
    Arap, Density, Derivatives, Jacobian, Lscm, RestShape, SymmetricDirichlet, Triangles,
};
use unwrapd::numerics::block::BlockPattern;

use crate::taylor::assert_taylor;

/// ψ of one triangle with the given rest shape, as a function of its six coordinates, is what derivatives are tested on:
/// gradient, projection and the way back to vertices at once.
pub fn assert_triangle_taylor(
    make: impl Fn(&[[u32; 3]], &[RestShape]) -> Box<dyn unwrapd::energy::Term>,
) {
    // Two triangles, one of them clockwise in its indices' order, both positive.
    let triangles = [[0, 1, 2], [2, 1, 3]];
    let rest = [
        RestShape::from_edges([1.1, 0.2], [0.3, 0.9]),
        RestShape::from_edges([0.8, -0.1], [0.2, 1.4]),
    ];
    let x = [0.1, 0.0, 0.9, 0.2, 0.2, 0.7, 1.4, 1.6];
    let d = [0.3, -0.2, 0.15, 0.4, -0.35, 0.2, 0.1, -0.3];
    let term = make(&triangles, &rest);
    let pattern = BlockPattern::new(4, term.stencils().into_iter());
    let mut gradient = vec![0.0; 8];
    let mut values = vec![0.0; pattern.scalar().row_idx.len()];
    term.add_derivatives(&x, 1.0, &pattern, &mut gradient, &mut values);
    let hessian = dense(&pattern, &values);
    let times = |v: &[f64]| {
        (0..8)
            .map(|i| (0..8).map(|j| hessian[(i, j)] * v[j]).sum())
            .collect()
    };
    assert_taylor(|x| term.value(x), &gradient, times, &x, &d);
    for vertex in 0..4 {
        let local = term.derivatives_around(vertex, &[0, 1], &x);
        assert_eq!(local.gradient[0], gradient[2 * vertex as usize]);
        assert_eq!(local.gradient[1], gradient[2 * vertex as usize + 1]);
    }
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

#[test]
fn taylor_arap() {
    assert_triangle_taylor(|t, r| Box::new(Triangles::new(t, r, Arap, NoBarrier)));
}

#[test]
fn taylor_lscm() {
    assert_triangle_taylor(|t, r| Box::new(Triangles::new(t, r, Lscm, NoBarrier)));
}

#[test]
fn taylor_symmetric_dirichlet() {
    assert_triangle_taylor(|t, r| Box::new(Triangles::new(t, r, SymmetricDirichlet, NoBarrier)));
}

#[test]
fn values_follow_from_singular_values() {
    let j = Jacobian::from_rows([[1.3, 0.4], [-0.2, 0.7]]);
    let [a, b] = j.singular_values();
    assert!((a * b - j.det).abs() < 1e-15);
    let arap = 0.5 * ((a - 1.0).powi(2) + (b - 1.0).powi(2));
    let symmetric = 0.5 * (a * a + b * b + a.powi(-2) + b.powi(-2));
    assert!((Arap.value(&j) - arap).abs() < 1e-14);
    assert!((Lscm.value(&j) - 0.5 * (a - b).powi(2)).abs() < 1e-14);
    assert!((SymmetricDirichlet.value(&j) - symmetric).abs() < 1e-14);
}

#[test]
fn symmetric_dirichlet_has_its_minimum_at_rotations() {
    let rotation =
        |angle: f64| Jacobian::from_rows([[angle.cos(), -angle.sin()], [angle.sin(), angle.cos()]]);
    for angle in [0.0, 0.3, 2.0, -1.1] {
        let j = rotation(angle);
        assert!((SymmetricDirichlet.value(&j) - 2.0).abs() < 1e-14);
        let Derivatives { twist, pp, mm, .. } = SymmetricDirichlet.derivatives(&j);
        assert!(twist.abs() < 1e-14 && pp > 0.0 && mm > 0.0);
    }
    let reflected = Jacobian::from_rows([[1.0, 0.0], [0.0, -1.0]]);
    assert_eq!(SymmetricDirichlet.value(&reflected), f64::INFINITY);
}

proptest! {
    /// The closed-form projection is the one by eigenvalues, for every τ.
    #[test]
    fn projection_clamps_eigenvalues(
        twist in -3.0..3.0_f64, flip in -3.0..3.0_f64,
        pp in -3.0..3.0_f64, pm in -3.0..3.0_f64, mm in -3.0..3.0_f64, tau in 0.0..=1.0_f64,
    ) {
        let projected = Derivatives { twist, flip, pp, pm, mm }.project(tau);
        let clamp = |lambda: f64| lambda.max(tau * lambda);
        prop_assert_eq!(projected.twist, clamp(twist));
        prop_assert_eq!(projected.flip, clamp(flip));
        let matrix = faer::mat![[pp, pm], [pm, mm]];
        let eigen = matrix.self_adjoint_eigen(Side::Lower).unwrap();
        let entry = |i: usize, j: usize| -> f64 {
            (0..2).map(|k| eigen.U()[(i, k)] * clamp(eigen.S()[k]) * eigen.U()[(j, k)]).sum()
        };
        prop_assert!((projected.pp - entry(0, 0)).abs() < 1e-12);
        prop_assert!((projected.pm - entry(1, 0)).abs() < 1e-12);
        prop_assert!((projected.mm - entry(1, 1)).abs() < 1e-12);
    }

    /// An assembled triangle is positive semidefinite with τ = 0, at any J.
    #[test]
    fn a_projected_triangle_is_positive_semidefinite(x in prop::array::uniform6(-2.0..2.0_f64)) {
        let rest = [RestShape::from_edges([1.0, 0.1], [0.2, 0.8])];
        let mut x = x;
        let edges = |x: &[f64; 6]| (x[2] - x[0]) * (x[5] - x[1]) - (x[3] - x[1]) * (x[4] - x[0]);
        if edges(&x) < 0.0 {
            x.swap(2, 4);
            x.swap(3, 5);
        }
        prop_assume!(edges(&x) > 1e-2);
        let term: Box<dyn unwrapd::energy::Term> =
            Box::new(Triangles::new(&[[0, 1, 2]], &rest, SymmetricDirichlet, NoBarrier));
        let pattern = BlockPattern::new(3, term.stencils().into_iter());
        let mut gradient = vec![0.0; 6];
        let mut values = vec![0.0; pattern.scalar().row_idx.len()];
        term.add_derivatives(&x, 0.0, &pattern, &mut gradient, &mut values);
        let eigenvalues = dense(&pattern, &values).self_adjoint_eigenvalues(Side::Lower).unwrap();
        prop_assert!(eigenvalues[0] > -1e-12 * eigenvalues[5]);
    }
}
