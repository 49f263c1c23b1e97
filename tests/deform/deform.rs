//! Handles: targets met, no inversion at any iterate, the paper's iteration beside ours, units.

use std::cell::{Cell, RefCell};

use unwrapd_deform::{Body, BodyElements, Handle, Model, Problem};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::{DensityKind, DisplacementKind, EnergyKind, RestShape};
use unwrapd_method::numerics::square::{Square, times, transposed};
use unwrapd_method::solver::{Control, Handles, Iterate, Path, Settings, Status};

use crate::bodies::sheet;
use crate::pulled::{bar, bent_strip, problem, strip, twisted_bar};

const ENERGIES: [EnergyKind; 10] = [
    EnergyKind::Density(DensityKind::Arap),
    EnergyKind::Density(DensityKind::Green),
    EnergyKind::Displacement(DisplacementKind::Dirichlet),
    EnergyKind::Displacement(DisplacementKind::Laplacian),
    EnergyKind::Displacement(DisplacementKind::UniformLaplacian),
    EnergyKind::Density(DensityKind::SymmetricDirichlet),
    EnergyKind::Density(DensityKind::Mips),
    EnergyKind::Density(DensityKind::Amips),
    EnergyKind::Density(DensityKind::StVenantKirchhoff),
    EnergyKind::Density(DensityKind::NeoHookean),
];

#[test]
fn every_energy_meets_its_targets_without_an_inversion() {
    for energy in ENERGIES.into_iter().chain([DensityKind::Lscm.into()]) {
        let problem = bent_strip(1.0, energy.clone(), BarrierKind::InverseSpline);
        let smallest = Cell::new(f64::INFINITY);
        let watch = |i: &Iterate| {
            smallest.set(smallest.get().min(i.smallest));
            Control::Continue
        };
        let solution = problem
            .solve(&Settings::follow(), &watch)
            .expect("a planar energy");
        assert_eq!(solution.summary.status, Status::Converged, "{energy:?}");
        assert!(solution.quality.residual < 1e-24, "{energy:?}");
        assert!(
            smallest.get() > 0.0 && solution.quality.inverted == 0,
            "{energy:?}"
        );
    }
}

#[test]
fn every_barrier_holds() {
    for kind in [
        BarrierKind::InverseSpline,
        BarrierKind::AugmentedLog,
        BarrierKind::Log,
        BarrierKind::NeoHookean,
    ] {
        let problem = bent_strip(1.0, DensityKind::Green, kind);
        let solution = problem
            .solve(&Settings::follow(), &go_on)
            .expect("a planar energy");
        assert_eq!(solution.quality.inverted, 0, "{kind:?}");
        assert!(solution.quality.residual < 1e-24, "{kind:?}");
    }
}

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

#[test]
fn a_bar_twists_by_half_a_turn_in_one_jump() {
    for energy in ENERGIES {
        let problem = twisted_bar(energy.clone());
        let solution = problem
            .solve(&Settings::follow(), &go_on)
            .expect("an energy of space");
        assert_eq!(solution.quality.inverted, 0, "{energy:?}");
        assert!(
            solution.quality.residual < 1e-24,
            "{energy:?} {:?}",
            solution.summary
        );
    }
    let planar = twisted_bar(DensityKind::Lscm);
    assert!(planar.solve(&Settings::follow(), &go_on).is_err());
}

/// The turns of a map of a [`bar`] about its axis: the rotations between neighboring layers, each less than half a turn.
fn turns(x: &[f64]) -> f64 {
    let layers = x.as_chunks::<3>().0.as_chunks::<4>().0;
    let diagonal = |layer: &[[f64; 3]; 4]| {
        let [y, z] = [1, 2].map(|k| layer[3][k] - layer[0][k]);
        z.atan2(y)
    };
    let angles: Vec<f64> = layers.iter().map(diagonal).collect();
    let between = angles
        .array_windows()
        .map(|[a, b]| (b - a).sin().atan2((b - a).cos()));
    between.sum::<f64>() / std::f64::consts::TAU
}

#[test]
fn a_bar_twisted_step_by_step_keeps_its_turns() {
    let length = 24;
    let body = Body::from(&bar(length));
    let held: Vec<u32> = (0..4).chain(4 * length..4 * length + 4).collect();
    let targets = |degrees: f64| -> Vec<f64> {
        let place = |&v: &u32| {
            let [x, y, z] = [0, 1, 2].map(|k| body.rest[3 * v as usize + k]);
            let angle = if v < 4 { degrees.to_radians() } else { 0.0 };
            let ([y, z], (sin, cos)) = ([y - 0.5, z - 0.5], angle.sin_cos());
            [x, 0.5 + cos * y - sin * z, 0.5 + sin * y + cos * z]
        };
        held.iter().flat_map(place).collect()
    };
    let (arap, spline) = (DensityKind::Arap.into(), BarrierKind::InverseSpline);
    let mut problem = problem(body.clone(), arap, spline, &held, targets(0.0));
    let first = problem.stations[0].clone();
    let stations = (1..=72).map(|step| Handles {
        targets: targets(15.0 * f64::from(step)),
        ..first.clone()
    });
    problem.stations = stations.collect();
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("an energy of space");
    assert_eq!(solution.summary.status, Status::Converged);
    assert_eq!(solution.quality.inverted, 0);
    let turns = turns(&solution.x).abs();
    assert!((turns - 3.0).abs() < 1e-6, "{turns}");
    // The tangent leads so near to the next minimum that few steps are left.
    let per_station = solution.summary.factorizations as f64 / problem.stations.len() as f64;
    assert!(per_station < 5.0, "{per_station}");
}

#[test]
fn the_papers_iteration_ends_in_the_same_minimum() {
    for energy in [
        EnergyKind::Density(DensityKind::Arap),
        EnergyKind::Density(DensityKind::Green),
        EnergyKind::Displacement(DisplacementKind::Dirichlet),
    ] {
        let problem = bent_strip(1.0, energy.clone(), BarrierKind::InverseSpline);
        let ours = problem
            .solve(&Settings::follow(), &go_on)
            .expect("a planar energy");
        let iterates = RefCell::new(Vec::new());
        let watch = |i: &Iterate| {
            iterates.borrow_mut().push(*i);
            Control::Continue
        };
        let theirs = problem
            .solve_by_levenberg(&problem.levenberg, &watch)
            .expect("a planar energy");
        assert_eq!(theirs.summary.status, Status::Converged, "{energy:?}");
        let iterates = iterates.into_inner();
        assert_eq!(iterates.len(), theirs.summary.iterations + 1);
        assert!(iterates[0].residual > 0.0 && iterates[0].sigma == 0.0);
        for [before, after] in iterates.array_windows() {
            assert!(after.mu > 0.0 && after.sigma > 0.0 && after.smallest > 0.0);
            assert!(after.alpha >= before.alpha);
        }
        let last = iterates[iterates.len() - 1];
        assert_eq!(last.barrier, theirs.quality.barrier);
        assert_eq!(last.residual, theirs.quality.residual);
        assert!(theirs.quality.residual < 1e-12 && theirs.quality.inverted == 0);
        let [a, b] = [ours, theirs].map(|s| s.quality.energy + s.quality.barrier);
        assert!((a - b).abs() < 1e-4 * b.abs(), "{energy:?}: {a} {b}");
    }
}

#[test]
fn an_arap_map_scales_with_the_unit() {
    // ARAP is an area, the barrier is not: without one the minimizer moves with the unit.
    let one = bent_strip(1.0, DensityKind::Arap, BarrierKind::None);
    let solve = |problem: &Problem| {
        problem
            .solve(&Settings::follow(), &go_on)
            .expect("a planar energy")
    };
    let base = solve(&one);
    for edge in [1e-6, 1e-3, 1e5] {
        let scaled = solve(&bent_strip(edge, DensityKind::Arap, BarrierKind::None));
        for (x, y) in base.x.iter().zip(&scaled.x) {
            assert!((edge * x - y).abs() < 1e-3 * edge, "{x} {y} at {edge}");
        }
        assert_eq!(scaled.summary.iterations, base.summary.iterations);
    }
}

#[test]
fn targets_out_of_reach_end_in_a_valid_map() {
    // The ring around a vertex is to be mirrored: the triangles around the vertex would be inverted.
    let body = Body::from(&sheet(4));
    let ring = [6, 7, 11, 13, 17, 18];
    let mirrored = ring.map(|v: usize| [4.0 - body.rest[2 * v], body.rest[2 * v + 1]]);
    let problem = problem(
        body,
        DensityKind::Arap.into(),
        BarrierKind::InverseSpline,
        &ring.map(|v| v as u32),
        mirrored.concat(),
    );
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a planar energy");
    assert_eq!(solution.summary.status, Status::TargetsUnreachable);
    assert_eq!(solution.quality.inverted, 0);
    assert!(solution.quality.residual > 0.0);
}

#[test]
fn a_weaker_barrier_costs_less_and_none_least() {
    let problem = bent_strip(1.0, DensityKind::Green, BarrierKind::InverseSpline);
    let settings = Settings::follow();
    let strong = problem.solve(&settings, &go_on).expect("a planar energy");
    let weak = problem
        .with_weaker_barrier(strong.clone(), &settings, &go_on)
        .expect("a planar energy");
    let free = problem
        .energy_without_barrier(&weak, &settings, &go_on)
        .expect("a planar energy");
    assert!(weak.quality.energy < strong.quality.energy);
    assert!(free <= weak.quality.energy * (1.0 + 1e-6));
    assert_eq!(weak.quality.inverted, 0);
}

#[test]
fn conformal_distortion_stays_below_its_bound() {
    let worst = |problem: &Problem, x: &[f64]| {
        let BodyElements::Triangles { corners, rest } = &problem.body.elements else {
            unreachable!("a strip");
        };
        let distortion = |(t, shape): (&[u32; 3], &RestShape)| {
            let [a, b, c] = t.map(|v| [x[2 * v as usize], x[2 * v as usize + 1]]);
            let edges = [b, c].map(|p| [p[0] - a[0], p[1] - a[1]]);
            let j = times(&transposed(&edges), &shape.inverse);
            let [s, t] = j.singular_values(j.det());
            s / t
        };
        corners.iter().zip(rest).map(distortion).fold(1.0, f64::max)
    };
    let mut problem = bent_strip(1.0, DensityKind::Arap, BarrierKind::InverseSpline);
    let free = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a planar energy");
    let unbounded = worst(&problem, &free.x);
    let bound = 0.8 * unbounded;
    problem.bound = Some(bound);
    let bounded = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a planar energy");
    assert_eq!(bounded.summary.status, Status::Converged);
    assert!(bounded.quality.residual < 1e-24);
    assert!(
        worst(&problem, &bounded.x) < bound,
        "{bound} of {unbounded}"
    );
    assert!(bounded.quality.energy > free.quality.energy);
}

#[test]
fn groups_are_connected_by_elements() {
    let body = Body::from(&strip(8, 1.0));
    let groups = body.groups(&[0, 1, 12, 26, 25]);
    assert_eq!(groups[0], groups[1]);
    assert_eq!(groups[3], groups[4]);
    assert!(groups[0] != groups[2] && groups[2] != groups[3] && groups[0] != groups[3]);
    assert!(matches!(body.elements, BodyElements::Triangles { .. }));
}

#[test]
fn a_group_travels_as_a_rigid_body() {
    let handles = Handles {
        vertices: vec![0, 1, 2, 3],
        // Half a turn about the x axis through (0, ½, ½), and a shift by 2 along it.
        targets: vec![2.0, 1.0, 1.0, 2.0, 1.0, 0.0, 2.0, 0.0, 1.0, 2.0, 0.0, 0.0],
        groups: vec![0; 4],
        ..Handles::default()
    };
    let x = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0];
    let path = Path::<3>::new(&handles, &x).expect("handles of the map");
    let distance =
        |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    for s in [0.0, 0.2, 0.5, 0.9, 1.0] {
        let places = [0, 1, 2, 3].map(|i| path.position(i, s));
        assert!((distance(places[0], places[1]) - 1.0).abs() < 1e-12);
        assert!((distance(places[0], places[3]) - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!(places.iter().all(|p| (p[0] - 2.0 * s).abs() < 1e-12));
    }
    for (i, target) in handles.targets.as_chunks::<3>().0.iter().enumerate() {
        assert!(distance(path.position(i, 1.0), *target) < 1e-12);
    }
}

#[test]
fn points_inside_elements_come_to_their_targets() {
    let body = Body::from(&strip(8, 1.0));
    let handles = [
        Handle::Disc {
            center: vec![0.0, 1.0],
            radius: 1.0,
            to: vec![0.0, 1.0],
            turn: 0.0,
            axis: None,
            weight: None,
        },
        Handle::Point {
            at: vec![7.3, 1.4],
            to: vec![5.0, 4.0],
            weight: None,
        },
        Handle::Vertex {
            vertex: 12,
            to: vec![4.5, 0.5],
            weight: None,
        },
    ];
    let problem = Problem::new(body, &handles, &ARAP).expect("handles of the strip");
    assert_eq!(problem.stations[0].vertices, [0, 1, 2, 4, 12]);
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a planar energy");
    assert_eq!(solution.summary.status, Status::Converged);
    assert!(solution.quality.residual < 1e-12, "{:?}", solution.quality);
    assert_eq!(solution.quality.inverted, 0);
}

const ARAP: Model = Model {
    energy: EnergyKind::Density(DensityKind::Arap),
    barrier: BarrierKind::InverseSpline,
    barrier_strength: None,
    barrier_support: 1.0,
    max_conformal: None,
    bijective: false,
};

#[test]
fn handles_that_cannot_be_have_names() {
    let vertex = |vertex, to: &[f64]| Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    };
    let point = |at: &[f64]| Handle::Point {
        at: at.to_vec(),
        to: vec![0.0, 0.0],
        weight: None,
    };
    let disc = |radius, turn| Handle::Disc {
        center: vec![50.0, 50.0],
        radius,
        to: vec![0.0, 0.0],
        turn,
        axis: None,
        weight: None,
    };
    for (handles, code) in [
        (vec![], "no_handle"),
        (vec![vertex(99, &[0.0, 0.0])], "unknown_handle"),
        (vec![vertex(1, &[0.0, f64::NAN])], "bad_target"),
        (vec![vertex(1, &[0.0, 0.0, 0.0])], "bad_target"),
        (
            vec![vertex(1, &[0.0, 0.0]), vertex(1, &[0.0, 1.0])],
            "contradictory_handles",
        ),
        (vec![point(&[100.0, 0.0])], "handle_outside"),
        (vec![disc(1.0, 0.0)], "handle_outside"),
        (vec![disc(-1.0, 0.0)], "bad_parameter"),
    ] {
        let error = Problem::new(Body::from(&strip(8, 1.0)), &handles, &ARAP).expect_err(code);
        assert_eq!(error.code(), code);
        assert!(!error.to_string().is_empty());
    }
    let strong = Model {
        barrier_strength: Some(-1.0),
        ..ARAP
    };
    let error = Problem::new(
        Body::from(&strip(8, 1.0)),
        &[vertex(0, &[0.0, 0.0])],
        &strong,
    );
    assert_eq!(
        error.expect_err("a negative strength").code(),
        "bad_parameter"
    );
}
