//! Barriers: derivatives, domain.

use std::sync::Arc;

use unwrapd_method::barrier::{Barrier, BarrierKind, Bounded, InverseSpline, NoBarrier, epsilon};
use unwrapd_method::energy::{
    Arap, DensityKind, Guard, Lscm, SymmetricDirichlet, Term, Triangles, Zero,
};

use crate::taylor::assert_taylor;
use crate::terms::{assert_plane_taylor, assert_space_taylor};

const SPLINE: InverseSpline = InverseSpline {
    beta: 0.7,
    s: 1.3,
    epsilon: 0.02,
};

const KINDS: [BarrierKind; 4] = [
    BarrierKind::InverseSpline,
    BarrierKind::AugmentedLog,
    BarrierKind::Log,
    BarrierKind::NeoHookean,
];

fn barrier(kind: BarrierKind) -> Barrier {
    Barrier {
        kind,
        beta: 0.7,
        s: 1.3,
        epsilon: 0.02,
    }
}

#[test]
fn taylor_guards() {
    for guard in KINDS.map(barrier) {
        for det in [0.06, 0.3, 0.9, 1.15] {
            let [first, second] = guard.derivatives(det, 0.8);
            let d = 0.5 * (det - guard.floor(0.8));
            let value = |x: &[f64]| guard.value(x[0], 0.8);
            assert_taylor(value, &[first], |v| vec![second * v[0]], &[det], &[d]);
        }
    }
}

#[test]
fn taylor_every_barrier_on_every_density() {
    for guard in KINDS.map(barrier) {
        assert_plane_taylor(Arap, guard);
        assert_plane_taylor(Lscm, guard);
        assert_plane_taylor(SymmetricDirichlet, guard);
        assert_plane_taylor(Zero, guard);
        assert_space_taylor(Arap, guard);
        assert_space_taylor(SymmetricDirichlet, guard);
        assert_space_taylor(Zero, guard);
    }
}

#[test]
fn taylor_bounded() {
    for bound in [2.5, 4.0, 100.0] {
        let density = Bounded {
            density: Arc::new(Arap),
            bound,
            beta: 0.3,
        };
        assert_plane_taylor(density, Barrier::NONE);
    }
}

#[test]
fn guards_rest_at_rest() {
    for kind in [BarrierKind::InverseSpline, BarrierKind::AugmentedLog] {
        let guard = Barrier {
            s: 1.0,
            ..barrier(kind)
        };
        let [first, second] = guard.derivatives(1.0, 0.8);
        assert!(guard.value(1.0, 0.8).abs() < 1e-15 && first.abs() < 1e-12 && second >= 0.0);
    }
}

#[test]
fn guards_are_infinite_at_epsilon() {
    for guard in KINDS.map(barrier) {
        let floor = guard.floor(0.8);
        assert_eq!(guard.value(floor, 0.8), f64::INFINITY);
        assert_eq!(guard.value(-1.0, 0.8), f64::INFINITY);
        assert!(guard.value(floor * (1.0 + 1e-9), 0.8) > guard.value(2.0 * floor, 0.8));
    }
}

#[test]
fn spline_is_infinite_at_epsilon() {
    let rest_area = 0.5;
    let floor = SPLINE.floor(rest_area);
    assert_eq!(floor * rest_area, SPLINE.epsilon);
    assert_eq!(SPLINE.value(floor, rest_area), f64::INFINITY);
    assert_eq!(SPLINE.value(-1.0, rest_area), f64::INFINITY);
    assert!(SPLINE.value(floor * (1.0 + 1e-9), rest_area) > 1e6);
}

#[test]
fn spline_ends_twice_differentiable_at_its_support() {
    let floor = SPLINE.floor(1.0);
    let end = floor + SPLINE.s * (1.0 - floor);
    assert_eq!(SPLINE.value(end * 1.000_001, 1.0), 0.0);
    assert_eq!(SPLINE.derivatives(end * 1.000_001, 1.0), [0.0; 2]);
    let inside = end * (1.0 - 1e-7);
    assert!(SPLINE.value(inside, 1.0).abs() < 1e-15);
    let [first, second] = SPLINE.derivatives(inside, 1.0);
    assert!((-1e-12..=0.0).contains(&first) && (0.0..1e-6).contains(&second));
}

#[test]
fn spline_is_the_papers_formula() {
    let (det, rest_area) = (0.4, 0.5);
    let c = det * rest_area - SPLINE.epsilon;
    let s = SPLINE.s * (rest_area - SPLINE.epsilon);
    let g = (c / s).powi(3) - 3.0 * (c / s).powi(2) + 3.0 * (c / s);
    let expected = SPLINE.beta * (1.0 / g - 1.0);
    assert!((SPLINE.value(det, rest_area) - expected).abs() < 1e-14);
}

#[test]
fn domains_in_words() {
    let rest = [unwrapd_method::energy::RestShape::from_edges(
        [1.0, 0.0],
        [0.0, 1.0],
    )];
    let barrier = |kind| Barrier {
        kind,
        beta: 0.01,
        s: 1.0,
        epsilon: epsilon(0.5, 0.5),
    };
    let flipped = [0.0, 0.0, 0.0, 1.0, 1.0, 0.0];
    for (energy, kind, forbids) in [
        (DensityKind::Arap, BarrierKind::InverseSpline, true),
        (DensityKind::Lscm, BarrierKind::InverseSpline, true),
        (DensityKind::SymmetricDirichlet, BarrierKind::None, true),
        (DensityKind::Arap, BarrierKind::None, false),
    ] {
        let density = energy.planar().expect("an energy of the plane");
        let term = Triangles::shared(&[[0, 1, 2]], &rest, density, barrier(kind));
        assert_eq!(term.forbids_flips(), forbids);
        assert_eq!(term.value(&flipped).is_infinite(), forbids);
        assert_eq!(term.smallest(&flipped), -1.0);
    }
    assert_eq!(NoBarrier.value(-1.0, 1.0), 0.0);
}
