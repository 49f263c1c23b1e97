//! The solver: descent and feasibility at every iterate.

use std::cell::RefCell;

use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::{DensityKind, RestShape, Triangles};
use unwrapd_method::solver::{
    Control, Iterate, Objective, Projection, RigidMotions, Settings, Status, best_scale, minimize,
};

use crate::taylor::assert_taylor;
use crate::terms::dense;

const NO_WATCH: fn(&Iterate) -> Control = |_| Control::Continue;

/// A square of `side` × `side` cells of edge 1, two triangles each.
struct Grid {
    positions: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
}

fn grid(side: u32) -> Grid {
    let row = side + 1;
    let positions = (0..row * row)
        .map(|v| [f64::from(v % row), f64::from(v / row)])
        .collect();
    let triangles = (0..side * side)
        .flat_map(|cell| {
            let a = cell / side * row + cell % side;
            [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]
        })
        .collect();
    Grid {
        positions,
        triangles,
    }
}

impl Grid {
    /// The grid bent over a saddle, its triangles laid flat: cannot be flattened without distortion.
    fn curved_rest(&self) -> Vec<RestShape> {
        let lift = |v: u32| {
            let [x, y] = self.positions[v as usize];
            [x, y, 0.15 * (x * x - 0.7 * y * y + x * y)]
        };
        let shapes = self.triangles.iter();
        shapes
            .map(|t| RestShape::from_corners(t.map(lift)))
            .collect()
    }

    fn flat_rest(&self) -> Vec<RestShape> {
        let place = |v: u32| {
            [
                self.positions[v as usize][0],
                self.positions[v as usize][1],
                0.0,
            ]
        };
        let shapes = self.triangles.iter();
        shapes
            .map(|t| RestShape::from_corners(t.map(place)))
            .collect()
    }

    /// Sheared, squeezed and trembling, without a flip.
    fn start(&self) -> Vec<f64> {
        let shaken = self.positions.iter().enumerate().flat_map(|(i, [x, y])| {
            let wave = (12.9 * i as f64).sin();
            [x + 0.8 * y + 0.1 * wave, 0.2 * y + 0.03 * wave]
        });
        shaken.collect()
    }

    fn objective(&self, rest: &[RestShape], energy: &DensityKind, kind: BarrierKind) -> Objective {
        let barrier = Barrier {
            kind,
            beta: 0.01,
            s: 1.0,
            epsilon: 1e-6,
        };
        let density = energy.planar().expect("an energy of the plane");
        let term = Triangles::shared(&self.triangles, rest, density, barrier);
        Objective::new(self.positions.len(), Box::new(term))
    }
}

const KINDS: [DensityKind; 3] = [
    DensityKind::Arap,
    DensityKind::Lscm,
    DensityKind::SymmetricDirichlet,
];

#[test]
fn energy_falls_and_no_triangle_inverts_at_any_iterate() {
    let grid = grid(12);
    for energy in &KINDS {
        for projection in [
            Projection::TrustRegion,
            Projection::Relaxed,
            Projection::PositiveSemidefinite,
        ] {
            let mut objective =
                grid.objective(&grid.curved_rest(), energy, BarrierKind::InverseSpline);
            let mut x = grid.start();
            let seen = RefCell::new(Vec::new());
            let watch = |i: &Iterate| {
                seen.borrow_mut().push(*i);
                Control::Continue
            };
            let settings = Settings {
                projection,
                ..Settings::normal()
            };
            let summary = minimize(&mut objective, &mut x, &settings, &watch);
            let seen = seen.into_inner();
            assert_eq!(summary.status, Status::Converged, "{energy:?}");
            assert_eq!(seen.len(), summary.iterations + 1);
            assert!(seen.iter().all(|i| i.smallest > 0.0));
            assert!(seen.windows(2).all(|w| w[1].energy < w[0].energy));
            assert_eq!(seen[0].energy, summary.energy_first);
            assert_eq!(objective.value(&x), summary.energy_last);
            assert!(summary.energy_last < 0.5 * summary.energy_first);
        }
    }
}

#[test]
fn taylor_assembled_objective() {
    let grid = grid(4);
    for energy in &KINDS {
        let mut objective = grid.objective(&grid.curved_rest(), energy, BarrierKind::InverseSpline);
        let x = grid.start();
        let d: Vec<f64> = (0..x.len())
            .map(|i| 0.05 * (3.3 * i as f64).cos())
            .collect();
        objective.linearize(&x, 1.0);
        let gradient = objective.gradient().to_vec();
        let (pattern, values) = objective.hessian();
        let hessian = dense(pattern, values);
        let times = |v: &[f64]| {
            let n = v.len();
            (0..n)
                .map(|i| (0..n).map(|j| hessian[(i, j)] * v[j]).sum())
                .collect()
        };
        assert_taylor(|x| objective.value(x), &gradient, times, &x, &d);
    }
}

#[test]
fn one_factorization_serves_several_directions() {
    let grid = grid(12);
    let rest = grid.curved_rest();
    let ended = |projection| {
        let mut objective = grid.objective(&rest, &DensityKind::Arap, BarrierKind::InverseSpline);
        let settings = Settings {
            projection,
            ..Settings::exact()
        };
        minimize(&mut objective, &mut grid.start(), &settings, &NO_WATCH)
    };
    let region = ended(Projection::TrustRegion);
    let relaxed = ended(Projection::Relaxed);
    assert_eq!(region.status, Status::Converged);
    assert!(
        (region.energy_last - relaxed.energy_last).abs() < 1e-8 * relaxed.energy_last,
        "{region:?} and {relaxed:?}"
    );
    assert!(region.factorizations < region.iterations, "{region:?}");
    assert!(
        region.factorizations < relaxed.factorizations,
        "{relaxed:?}"
    );
}

#[test]
fn a_developable_surface_is_flattened_exactly() {
    let grid = grid(8);
    for (energy, minimum) in [
        (&DensityKind::Arap, 0.0),
        (&DensityKind::SymmetricDirichlet, 4.0),
    ] {
        let mut objective = grid.objective(&grid.flat_rest(), energy, BarrierKind::None);
        // ARAP without a barrier may flip; from a start this near it does not.
        let mut x: Vec<f64> = grid.start();
        for (x, p) in x.iter_mut().zip(grid.positions.iter().flatten()) {
            *x = 0.1 * *x + 0.9 * p;
        }
        let summary = minimize(&mut objective, &mut x, &Settings::exact(), &NO_WATCH);
        assert_eq!(summary.status, Status::Converged);
        let area = 64.0;
        assert!(
            (summary.energy_last / area - minimum).abs() < 1e-9,
            "{summary:?}"
        );
        assert!(summary.iterations < 15, "{summary:?}");
    }
}

#[test]
fn the_largest_step_is_where_the_first_triangle_collapses() {
    let grid = grid(3);
    let objective = grid.objective(
        &grid.flat_rest(),
        &DensityKind::SymmetricDirichlet,
        BarrierKind::None,
    );
    let x: Vec<f64> = grid.positions.iter().flatten().copied().collect();
    // One inner vertex moves to the right, over its neighbor at distance 1: the area is linear in the step.
    let mut d = vec![0.0; x.len()];
    d[2 * 5] = 4.0;
    assert!((objective.largest_step(&x, &d) - 0.25).abs() < 1e-15);
    // All shrink toward the origin: a double root at 1.
    let inward: Vec<f64> = x.iter().map(|x| -x).collect();
    assert!((objective.largest_step(&x, &inward) - 1.0).abs() < 1e-7);
    let outward = x.clone();
    assert_eq!(objective.largest_step(&x, &outward), f64::INFINITY);
}

#[test]
fn fixed_vertices_stay_and_the_rest_moves() {
    let grid = grid(6);
    let rest = grid.flat_rest();
    let mut objective = grid.objective(&rest, &DensityKind::Lscm, BarrierKind::None);
    let fixed = [0, 48];
    objective.fix(&fixed);
    let mut x = grid.start();
    let before = x.clone();
    let summary = minimize(&mut objective, &mut x, &Settings::normal(), &NO_WATCH);
    assert_eq!(summary.status, Status::Converged);
    for v in fixed {
        assert_eq!(x[2 * v as usize..][..2], before[2 * v as usize..][..2]);
    }
    // A flat mesh with two vertices held is mapped by a similarity.
    assert!(
        summary.energy_last < 1e-8 * summary.energy_first,
        "{summary:?}"
    );
    assert!(x != before);
}

#[test]
fn a_hessian_that_nothing_holds_is_regularized_all_the_same() {
    // Said to be held, but free: its Hessian is singular.
    let grid = grid(8);
    let (energy, kind) = (DensityKind::SymmetricDirichlet, BarrierKind::None);
    let mut objective = grid.objective(&grid.flat_rest(), &energy, kind);
    objective.set_rigid_motions(RigidMotions::Held);
    let mut x = grid.start();
    let summary = minimize(&mut objective, &mut x, &Settings::normal(), &NO_WATCH);
    assert_eq!(summary.status, Status::Converged);
    assert!(
        (summary.energy_last / 256.0 - 1.0).abs() < 1e-5,
        "{summary:?}"
    );
}

#[test]
fn the_watcher_ends_it_with_a_valid_map() {
    let grid = grid(6);
    let mut objective = grid.objective(
        &grid.curved_rest(),
        &DensityKind::Arap,
        BarrierKind::InverseSpline,
    );
    let mut x = grid.start();
    let watch = |i: &Iterate| {
        if i.iteration == 2 {
            Control::Finish
        } else {
            Control::Continue
        }
    };
    let summary = minimize(&mut objective, &mut x, &Settings::normal(), &watch);
    assert_eq!((summary.status, summary.iterations), (Status::Stopped, 2));
    assert!(objective.value(&x).is_finite());
    let limited = Settings {
        max_iterations: 1,
        ..Settings::exact()
    };
    let summary = minimize(&mut objective, &mut x, &limited, &NO_WATCH);
    assert_eq!(summary.status, Status::IterationLimit);
}

#[test]
fn a_start_outside_the_domain_is_left_alone() {
    let grid = grid(3);
    let mut objective = grid.objective(
        &grid.flat_rest(),
        &DensityKind::Arap,
        BarrierKind::InverseSpline,
    );
    let mirrored: Vec<f64> = grid.positions.iter().flat_map(|[x, y]| [-x, *y]).collect();
    let mut x = mirrored.clone();
    let summary = minimize(&mut objective, &mut x, &Settings::normal(), &NO_WATCH);
    assert_eq!((summary.status, summary.iterations), (Status::Stalled, 0));
    assert_eq!(x, mirrored);
}

#[test]
fn equal_input_gives_equal_bits() {
    let grid = grid(10);
    let run = || {
        let mut objective = grid.objective(
            &grid.curved_rest(),
            &DensityKind::Arap,
            BarrierKind::InverseSpline,
        );
        let mut x = grid.start();
        let summary = minimize(&mut objective, &mut x, &Settings::normal(), &NO_WATCH);
        (x.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), summary)
    };
    assert_eq!(run(), run());
}

#[test]
fn the_best_scale_is_found_from_far_off() {
    let grid = grid(5);
    let objective = grid.objective(
        &grid.flat_rest(),
        &DensityKind::SymmetricDirichlet,
        BarrierKind::None,
    );
    for factor in [1e-5, 0.9, 3e4] {
        let x: Vec<f64> = grid
            .positions
            .iter()
            .flatten()
            .map(|x| factor * x)
            .collect();
        assert!((factor * best_scale(&|x: &[f64]| objective.value(x), &x) - 1.0).abs() < 0.01);
    }
    // A domain that ends above or below the start.
    for (domain, best) in [(0.0..0.3, 0.25), (5.0..9.0, 8.0)] {
        let value = |x: &[f64]| {
            if domain.contains(&x[0]) {
                -x[0]
            } else {
                f64::INFINITY
            }
        };
        assert!((best_scale(&value, &[1.0]) / best - 1.0).abs() < 0.3);
    }
    let flipped: Vec<f64> = grid.positions.iter().flat_map(|[x, y]| [*y, *x]).collect();
    assert_eq!(best_scale(&|x: &[f64]| objective.value(x), &flipped), 1.0);
}
