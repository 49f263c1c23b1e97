//! Deformations do not depend on the unit, the place, the direction and the order of their mesh.

use unwrapd_deform::{Body, Handle, Model, Problem, Solution, Units};
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::elsewhere::{Elsewhere, HERE};
use crate::pulled::{bar, strip};
use unwrapd_method::energy::{DensityKind, DisplacementKind};

/// Both ends of a strip held, one of them turned and brought near the other.
fn bent(model: &Model) -> Problem {
    let disc = |center: [f64; 2], to: [f64; 2], turn: f64| Handle::Disc {
        center: center.to_vec(),
        radius: 1.1,
        to: to.to_vec(),
        turn,
        axis: None,
        weight: None,
    };
    let handles = [
        disc([0.0, 1.0], [0.0, 1.0], 0.0),
        disc([8.0, 1.0], [4.0, 5.0], 120.0),
    ];
    Problem::new(Body::from(&strip(8, 1.0)), &handles, model).expect("handles of the strip")
}

/// A bar of which one end is held and the other is pulled aside: by its vertices, or by a point.
fn pulled(model: &Model, by_a_point: bool) -> Problem {
    let ball = |center: [f64; 3], to: [f64; 3]| Handle::Disc {
        center: center.to_vec(),
        radius: 1.0,
        to: to.to_vec(),
        turn: 0.0,
        axis: None,
        weight: None,
    };
    let held = ball([0.0, 0.5, 0.5], [0.0, 0.5, 0.5]);
    let pulled = if by_a_point {
        Handle::Point {
            at: vec![5.6, 0.4, 0.7],
            to: vec![3.0, 3.0, 1.0],
            weight: None,
        }
    } else {
        ball([6.0, 0.5, 0.5], [3.0, 3.0, 1.0])
    };
    Problem::new(Body::from(&bar(6)), &[held, pulled], model).expect("handles of the bar")
}

fn solved(problem: &Problem) -> Solution {
    let go_on = |_: &Iterate| Control::Continue;
    let solution = problem.solve(&Settings::follow(), &go_on);
    solution.expect("an energy of its dimension")
}

/// Of several energies, and whether the number of iterations repeats: points are pulled so strongly in
/// the end that rounding decides when they have settled.
fn problems() -> Vec<(Problem, bool)> {
    let energies = [
        DensityKind::Arap.into(),
        DensityKind::Green.into(),
        DisplacementKind::Laplacian.into(),
        DensityKind::NeoHookean.into(),
    ];
    let of = |energy| {
        let model = Model {
            energy,
            ..Model::default()
        };
        [
            (bent(&model), true),
            (pulled(&model, false), true),
            (pulled(&model, true), false),
        ]
    };
    energies.into_iter().flat_map(of).collect()
}

#[test]
fn a_problem_posed_elsewhere_has_the_same_solution() {
    let scales = [1e-6, 1e-3, 1e3, 1e6].map(|scale| Elsewhere { scale, ..HERE });
    let turns = [0.4, 2.0, 4.5].map(|turn| Elsewhere { turn, ..HERE });
    let orders = [1, 5, 9].map(|first| Elsewhere { first, ..HERE });
    let far = Elsewhere { shift: 1e4, ..HERE };
    let places = || scales.iter().chain(&turns).chain(&orders).chain([&far]);
    for (problem, repeats) in problems() {
        let here = &solved(&problem);
        assert_eq!(here.summary.status, Status::Converged);
        for elsewhere in places() {
            let there = &solved(&elsewhere.pose(&problem));
            let what = format!("{:?} {elsewhere:?}", problem.energy);
            let difference = there.quality.energy / here.quality.energy - 1.0;
            assert!(difference.abs() < 1e-6, "{what}: {difference:e}");
            let [there, here] = [there, here].map(|it| it.summary.iterations);
            assert!(
                !repeats || 10 * there.abs_diff(here) <= here,
                "{what}: {there}, not {here}"
            );
        }
    }
}

#[test]
fn solutions_are_in_the_unit_of_their_mesh() {
    let problem = bent(&Model::default());
    let here = solved(&problem);
    let elsewhere = Elsewhere { scale: 1e3, ..HERE };
    let posed = elsewhere.pose(&problem);
    let there = solved(&posed);
    for (x, y) in here.x.iter().zip(&there.x) {
        assert!((1e3 * x - y).abs() < 1e-3, "{x} {y}");
    }
    // Those that are held stand at their targets to the bit.
    let handles = &posed.stations[0];
    let targets = handles.targets.as_chunks::<2>().0;
    for (&v, target) in handles.vertices.iter().zip(targets) {
        assert_eq!(&there.x.as_chunks::<2>().0[v as usize], target);
    }
    let energy = posed.quality(&there.x).energy / there.quality.energy;
    assert!((energy - 1.0).abs() < 1e-12, "{energy}");
    assert_eq!(there.quality.residual, 0.0);
}

#[test]
fn a_problem_means_its_numbers_as_given_if_it_says_so() {
    let normalized = bent(&Model::default());
    let given = Problem {
        units: Units::Given,
        ..normalized.clone()
    };
    // A triangle of the strip has area ½: in its own unit, half the energy of the normalized one.
    let [normalized, given] = [normalized, given].map(|problem| solved(&problem).quality);
    let ratio = normalized.energy / given.energy;
    assert!((ratio - 2.0).abs() < 1e-2, "{ratio}");
}
