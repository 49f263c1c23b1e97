//! Densities: derivatives, projection, minima.

use faer::{Mat, Side};
use proptest::prelude::*;
use unwrapd_method::barrier::{Barrier, BarrierKind, NoBarrier};
use unwrapd_method::energy::{
    AlignedEdge, Alignment, Amips, Arap, Density, FoldoverFree, FrozenArap, Green, Lscm, Mips,
    Modes, NeoHookean, Positional, RestShape, StVenantKirchhoff, SymmetricDirichlet, Term,
    Tetrahedra, Triangles, Zero, biharmonic, dirichlet, uniform_biharmonic, voronoi_areas,
};
use unwrapd_method::numerics::square::{Matrix, Square, times, transposed};

use crate::terms::{
    PLANE, PLANE_WAY, SPACE, SPACE_WAY, TETRAHEDRA, TRIANGLES, assert_plane_taylor,
    assert_space_taylor, assert_term_taylor, derivatives, plane_rest, space_rest,
};

const LAME: StVenantKirchhoff = StVenantKirchhoff {
    lambda: 1.3,
    mu: 0.4,
};
const RUBBER: NeoHookean = NeoHookean {
    lambda: 1.3,
    mu: 0.4,
};

#[test]
fn taylor_densities_in_the_plane() {
    assert_plane_taylor(Arap, Barrier::NONE);
    assert_plane_taylor(Lscm, Barrier::NONE);
    assert_plane_taylor(SymmetricDirichlet, Barrier::NONE);
    assert_plane_taylor(Green, Barrier::NONE);
    assert_plane_taylor(LAME, Barrier::NONE);
    assert_plane_taylor(RUBBER, Barrier::NONE);
    assert_plane_taylor(Mips, Barrier::NONE);
    assert_plane_taylor(Amips { s: 1.5 }, Barrier::NONE);
}

#[test]
fn taylor_densities_in_space() {
    assert_space_taylor(Arap, Barrier::NONE);
    assert_space_taylor(SymmetricDirichlet, Barrier::NONE);
    assert_space_taylor(Green, Barrier::NONE);
    assert_space_taylor(LAME, Barrier::NONE);
    assert_space_taylor(RUBBER, Barrier::NONE);
    assert_space_taylor(Mips, Barrier::NONE);
    assert_space_taylor(Amips { s: 1.5 }, Barrier::NONE);
}

/// Where elements are inverted, where they are not, and at ε = 0.
#[test]
fn taylor_foldover_free() {
    let of = |epsilon| FoldoverFree {
        epsilon,
        lambda: 0.2,
    };
    for epsilon in [0.0, 0.1, 2.0] {
        assert_plane_taylor(of(epsilon), Barrier::NONE);
        assert_space_taylor(of(epsilon), Barrier::NONE);
    }
    let mirrored = |x: &[f64], dim: usize| -> Vec<f64> {
        let sign = |i: usize| if i.is_multiple_of(dim) { -1.0 } else { 1.0 };
        x.iter().enumerate().map(|(i, x)| sign(i) * x).collect()
    };
    let plane = Triangles::new(&TRIANGLES, &plane_rest(), of(0.3), NoBarrier);
    let space = Tetrahedra::new(&TETRAHEDRA, &space_rest(), of(0.3), NoBarrier);
    assert!(plane.smallest(&mirrored(&PLANE, 2)) < 0.0);
    assert_term_taylor(&plane, &mirrored(&PLANE, 2), &PLANE_WAY);
    assert!(space.smallest(&mirrored(&SPACE, 3)) < 0.0);
    assert_term_taylor(&space, &mirrored(&SPACE, 3), &SPACE_WAY);
}

#[test]
fn taylor_positional() {
    let points = Positional {
        dim: 2,
        rows: vec![vec![(0, 1.0)], vec![(1, 0.2), (2, 0.5), (3, 0.3)]],
        targets: vec![0.4, 0.1, -0.3, 0.8],
        alpha: 1.7,
    };
    assert_term_taylor(&points, &PLANE, &PLANE_WAY);
}

#[test]
fn taylor_alignment() {
    let edge = |vertices: [u32; 2], coordinate, length| AlignedEdge {
        vertices,
        coordinate,
        length,
    };
    let aligned = Alignment {
        edges: vec![edge([0, 1], 0, 0.7), edge([1, 3], 1, 1.3)],
        alpha: 1.7,
    };
    assert_term_taylor(&aligned, &PLANE, &PLANE_WAY);
    // An edge of length 2 at 30 degrees to the first axis adds 2 sin² 30°.
    let one = Alignment {
        edges: vec![edge([0, 1], 1, 2.0)],
        alpha: 1.0,
    };
    let turned = [0.0, 0.0, 3.0_f64.sqrt(), 1.0];
    assert!((one.value(&turned) - 0.5).abs() < 1e-15);
    assert_eq!(one.value(&[5.0, 7.0, 6.0, 7.0]), 0.0);
}

#[test]
fn taylor_quadratic() {
    let shapes = plane_rest();
    let sizes = shapes.map(|shape| shape.size);
    let corners: Vec<&[u32]> = TRIANGLES.iter().map(<[u32; 3]>::as_slice).collect();
    let rest = PLANE_WAY.to_vec();
    let masses = [0.3, 0.5, 0.4, 0.2];
    let terms = [
        dirichlet(&corners, &shapes, &sizes, rest.clone()),
        biharmonic(&corners, &shapes, &sizes, &masses, rest.clone()),
        uniform_biharmonic(2, &corners, rest),
    ];
    for term in &terms {
        assert_term_taylor(term, &PLANE, &PLANE_WAY);
        assert_eq!(term.value(&PLANE_WAY), 0.0);
    }
    let shapes = space_rest();
    let sizes = shapes.map(|shape| shape.size);
    let corners: Vec<&[u32]> = TETRAHEDRA.iter().map(<[u32; 4]>::as_slice).collect();
    let term = dirichlet(&corners, &shapes, &sizes, SPACE_WAY.to_vec());
    assert_term_taylor(&term, &SPACE, &SPACE_WAY);
}

#[test]
fn dirichlet_is_the_distance_from_the_identity() {
    let rest = [0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    let shape = [RestShape::from_edges([1.0, 0.0], [0.0, 2.0])];
    let term = dirichlet(&[&[0, 1, 2]], &shape, &[1.0], rest.to_vec());
    // J = diag(3, 1.5): ½ A (2² + 0.5²) with A = 1.
    let x = [0.0, 0.0, 3.0, 0.0, 0.0, 3.0];
    assert!((term.value(&x) - 2.125).abs() < 1e-14);
}

#[test]
fn voronoi_areas_sum_to_the_area() {
    // The second triangle is obtuse.
    let x = [[0.0, 0.0], [1.0, 0.0], [0.4, 0.9], [4.0, 0.8]];
    let masses = voronoi_areas(4, &[[0, 1, 2], [1, 3, 2]], &x);
    let areas = 0.45 + 0.5 * (3.0 * 0.9 + 0.6 * 0.8);
    assert!((masses.iter().sum::<f64>() - areas).abs() < 1e-14);
    assert!(masses.iter().all(|&m| m > 0.0));
}

#[test]
fn singular_values_meet_the_definitions() {
    let j: Matrix<2> = [[1.3, 0.4], [-0.2, 0.7]];
    let sigma = j.singular_values(j.det());
    let [a, b] = sigma;
    let norm: f64 = j.as_flattened().iter().map(|x| x * x).sum();
    assert!((a * a + b * b - norm).abs() < 1e-14);
    let arap = 0.5 * ((a - 1.0).powi(2) + (b - 1.0).powi(2));
    let symmetric = a * a + b * b + a.powi(-2) + b.powi(-2);
    assert!((Arap.value(&sigma) - arap).abs() < 1e-14);
    assert!((Lscm.value(&sigma) - 0.5 * (a - b).powi(2)).abs() < 1e-14);
    assert!((SymmetricDirichlet.value(&sigma) - symmetric).abs() < 1e-14);
    let green: f64 = (0..2)
        .flat_map(|r| (0..2).map(move |c| (r, c)))
        .map(|(r, c)| {
            let gram = times(&transposed(&j), &j);
            (gram[r][c] - f64::from(u8::from(r == c))).powi(2)
        })
        .sum();
    assert!((Green.value(&sigma) - green).abs() < 1e-13);
}

#[test]
fn minima_are_at_rotations() {
    fn assert_rest<const D: usize>(density: &dyn Density<D>, minimum: f64) {
        let one = [1.0; D];
        assert!((density.value(&one) - minimum).abs() < 1e-14);
        assert!(density.gradient(&one).iter().all(|g| g.abs() < 1e-14));
        let modes = Modes::new(density, &one, 1.0);
        for i in 0..D {
            for j in i + 1..D {
                assert!(modes.twist[i][j].abs() < 1e-14 && modes.flip[i][j] > 0.0);
            }
        }
    }
    assert_rest::<2>(&SymmetricDirichlet, 4.0);
    assert_rest::<3>(&SymmetricDirichlet, 6.0);
    assert_rest::<2>(&Mips, 1.0);
    assert_rest::<3>(&Mips, 1.0);
    assert_rest::<3>(&Amips { s: 1.0 }, 1.0_f64.exp());
    assert_rest::<3>(&Green, 0.0);
    assert_rest::<3>(&LAME, 0.0);
    assert_rest::<3>(&RUBBER, 0.0);
    assert_eq!(
        Density::<2>::value(&SymmetricDirichlet, &[1.0, -1.0]),
        f64::INFINITY
    );
}

#[test]
fn frozen_arap_is_a_majorizer() {
    let frozen = Tetrahedra::new(&TETRAHEDRA, &space_rest(), FrozenArap, NoBarrier);
    let arap = Tetrahedra::new(&TETRAHEDRA, &space_rest(), Arap, NoBarrier);
    let (gradient, hessian) = derivatives(&frozen, &SPACE, 1.0);
    assert_eq!(gradient, derivatives(&arap, &SPACE, 1.0).0);
    for scale in [-1.0, -0.3, 0.1, 0.7, 2.0] {
        let d = SPACE_WAY.map(|d| scale * d);
        let moved: Vec<f64> = SPACE.iter().zip(&d).map(|(x, d)| x + d).collect();
        let linear: f64 = gradient.iter().zip(&d).map(|(g, d)| g * d).sum();
        let quadratic: f64 = (0..15)
            .flat_map(|i| (0..15).map(move |j| (i, j)))
            .map(|(i, j)| 0.5 * hessian[(i, j)] * d[i] * d[j])
            .sum();
        let model = arap.value(&SPACE) + linear + quadratic;
        assert!(
            model >= arap.value(&moved) - 1e-12,
            "{model} {} at {scale}",
            arap.value(&moved)
        );
    }
}

/// The Hessian in J from finite differences of nothing: a term of one element whose gradients are the unit vectors has it as
/// a block of its own, so its eigenvalues are those of the modes.
fn assert_projection<const D: usize>(hessian: &Mat<f64>, projected: &Mat<f64>, tau: f64) {
    let eigen = hessian.self_adjoint_eigen(Side::Lower).unwrap();
    let n = hessian.nrows();
    let size = (0..n).map(|k| eigen.S()[k].abs()).fold(0.0, f64::max);
    for i in 0..n {
        for j in 0..n {
            let entry: f64 = (0..n)
                .map(|k| {
                    eigen.S()[k].max(tau * eigen.S()[k]) * eigen.U()[(i, k)] * eigen.U()[(j, k)]
                })
                .sum();
            assert!(
                (projected[(i, j)] - entry).abs() <= 1e-9 * size,
                "{i} {j} of {D}D: {} {entry}",
                projected[(i, j)]
            );
        }
    }
}

/// The Hessian in the coordinates of all vertices but the first, which with unit rest edges are those of J.
fn in_jacobian(term: &dyn Term, x: &[f64], tau: f64) -> Mat<f64> {
    let (_, hessian) = derivatives(term, x, tau);
    let dim = term.dim();
    Mat::from_fn(dim * dim, dim * dim, |i, j| hessian[(dim + i, dim + j)])
}

fn spline(epsilon: f64) -> Barrier {
    Barrier {
        kind: BarrierKind::InverseSpline,
        beta: 0.3,
        s: 1.0,
        epsilon,
    }
}

fn unit_triangle(density: impl Density<2> + 'static) -> Triangles {
    let rest = [RestShape::from_edges([1.0, 0.0], [0.0, 1.0])];
    Triangles::new(&[[0, 1, 2]], &rest, density, spline(1e-3))
}

fn unit_tetrahedron(density: impl Density<3> + 'static) -> Tetrahedra {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let rest = [RestShape::from_tetrahedron(corners)];
    Tetrahedra::new(&[[0, 1, 2, 3]], &rest, density, spline(1e-3))
}

#[test]
fn projection_at_equal_singular_values_is_the_one_by_eigenvalues() {
    for scale in [0.3, 0.8, 1.0, 1.7] {
        let (sin, cos) = 0.7_f64.sin_cos();
        let x = [
            0.0,
            0.0,
            scale * cos,
            scale * sin,
            -scale * sin,
            scale * cos,
        ];
        for term in [
            unit_triangle(Arap),
            unit_triangle(SymmetricDirichlet),
            unit_triangle(Green),
        ] {
            assert_projection::<2>(
                &in_jacobian(&term, &x, 1.0),
                &in_jacobian(&term, &x, 0.0),
                0.0,
            );
        }
        let x = [
            0.0,
            0.0,
            0.0,
            scale,
            0.0,
            0.0,
            0.0,
            cos * scale,
            sin * scale,
            0.0,
            -sin * scale,
            cos * scale,
        ];
        for term in [
            unit_tetrahedron(Arap),
            unit_tetrahedron(SymmetricDirichlet),
            unit_tetrahedron(Green),
        ] {
            assert_projection::<3>(
                &in_jacobian(&term, &x, 1.0),
                &in_jacobian(&term, &x, 0.0),
                0.0,
            );
        }
    }
}

proptest! {
    /// The closed-form projection is the one by eigenvalues, for every τ, in the plane …
    #[test]
    fn projection_in_the_plane(j in prop::array::uniform4(-2.0..2.0_f64), tau in 0.0..1.0_f64) {
        let [a, b, c, d] = j;
        let det = a * d - b * c;
        prop_assume!(det.abs() > 1e-2);
        let x = if det > 0.0 { [0.0, 0.0, a, b, c, d] } else { [0.0, 0.0, c, d, a, b] };
        for term in [unit_triangle(Arap), unit_triangle(SymmetricDirichlet), unit_triangle(Green), unit_triangle(Zero)] {
            assert_projection::<2>(&in_jacobian(&term, &x, 1.0), &in_jacobian(&term, &x, tau), tau);
        }
    }

    /// … and in space.
    #[test]
    fn projection_in_space(j in prop::array::uniform9(-2.0..2.0_f64), tau in 0.0..1.0_f64) {
        let mut rows: Matrix<3> = [[j[0], j[1], j[2]], [j[3], j[4], j[5]], [j[6], j[7], j[8]]];
        prop_assume!(rows.det().abs() > 1e-2);
        if rows.det() < 0.0 {
            rows.swap(0, 1);
        }
        let x: Vec<f64> = [0.0; 3].into_iter().chain(rows.as_flattened().to_vec()).collect();
        for term in [unit_tetrahedron(Arap), unit_tetrahedron(SymmetricDirichlet), unit_tetrahedron(Green), unit_tetrahedron(Zero)] {
            assert_projection::<3>(&in_jacobian(&term, &x, 1.0), &in_jacobian(&term, &x, tau), tau);
        }
    }
}
