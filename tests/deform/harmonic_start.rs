//! Bodies whose whole boundary is held on targets that are not convex: a valid map is found from rest and from any
//! start, with the boundary exactly in place.

use std::f64::consts::PI;

use unwrapd_deform::{Body, Handle, Model, Problem, Solution};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::DensityKind;
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::bodies::{block, sheet};

const SIDE: u32 = 16;

/// Vertices of a body's boundary: those with a coordinate of 0 or of its side.
fn boundary(body: &Body, side: u32) -> impl Iterator<Item = u32> {
    let is_side = move |x: &f64| *x == 0.0 || *x == f64::from(side);
    let places = body.rest.chunks_exact(body.dim()).zip(0..);
    let held = places.filter(move |(place, _)| place.iter().any(is_side));
    held.map(|(_, v)| v)
}

/// The problem that holds the boundary of a body at the images of its rest positions.
fn held<const D: usize>(
    body: Body,
    side: u32,
    model: &Model,
    image: impl Fn([f64; D]) -> [f64; D],
) -> Problem {
    let handle = |vertex: u32| {
        let place: [f64; D] = std::array::from_fn(|k| body.rest[D * vertex as usize + k]);
        let to = image(place).to_vec();
        Handle::Vertex {
            vertex,
            to,
            weight: None,
        }
    };
    let handles: Vec<Handle> = boundary(&body, side).map(handle).collect();
    Problem::new(body, &handles, model).expect("a problem")
}

/// A sheet whose border is held on a strip along a spiral of this many half turns.
fn spiral(turns: f64, model: &Model) -> Problem {
    let image = move |[x, y]: [f64; 2]| {
        let [along, across] = [x, y].map(|x| x / f64::from(SIDE));
        let angle = PI * turns * along;
        let radius = 1.9 + 0.5 * angle - 0.9 * across;
        [radius * angle.cos(), radius * angle.sin()]
    };
    held(Body::from(&sheet(SIDE)), SIDE, model, image)
}

/// A block whose surface is held on an arch of 200 degrees.
fn arch(model: &Model) -> Problem {
    const CELLS: u32 = 6;
    let image = |[x, y, z]: [f64; 3]| {
        let angle = 200_f64.to_radians() * x / f64::from(CELLS);
        let radius = 2.0 + y;
        [radius * angle.sin(), radius * angle.cos(), z]
    };
    held(Body::from(&block(CELLS)), CELLS, model, image)
}

fn solved(problem: &Problem) -> Solution {
    let go_on = |_: &Iterate| Control::Continue;
    problem.solve(&Settings::follow(), &go_on).expect("a map")
}

/// Asserts that the solution is a minimum without inversions, with every held vertex exactly at its target.
fn assert_reached(problem: &Problem, solution: &Solution) {
    assert_eq!(
        solution.summary.status,
        Status::Converged,
        "{:?}",
        solution.quality
    );
    let determinants = problem.body.determinants_at(&solution.x);
    assert!(
        determinants.iter().all(|&d| d > 0.0),
        "{:?}",
        solution.quality
    );
    assert_held(problem, &solution.x);
}

fn assert_held(problem: &Problem, x: &[f64]) {
    let (dim, handles) = (problem.body.dim(), &problem.stations[0]);
    for (i, &v) in handles.vertices.iter().enumerate() {
        let place = &x[dim * v as usize..dim * (v as usize + 1)];
        assert_eq!(place, &handles.targets[dim * i..dim * (i + 1)]);
    }
}

#[test]
fn a_border_on_a_spiral_is_reached_from_rest() {
    // From the harmonic start of the longest, the quasi-Newton method of the paper does not find a map.
    for turns in [1.2, 2.2, 3.2] {
        let problem = spiral(turns, &Model::default());
        assert_reached(&problem, &solved(&problem));
    }
}

#[test]
fn a_surface_on_an_arch_is_reached_from_rest() {
    let problem = arch(&Model::default());
    assert_reached(&problem, &solved(&problem));
}

/// Moves every free vertex of the start to one place, and every held one to its target.
fn collapsed(mut problem: Problem) -> Problem {
    let dim = problem.body.dim();
    problem.start.fill(0.25);
    for (i, &v) in problem.stations[0].vertices.iter().enumerate() {
        let target = &problem.stations[0].targets[dim * i..dim * (i + 1)];
        problem.start[dim * v as usize..dim * (v as usize + 1)].copy_from_slice(target);
    }
    problem
}

#[test]
fn untangling_holds_what_is_at_its_target() {
    for barrier in [BarrierKind::InverseSpline, BarrierKind::None] {
        let model = Model {
            energy: DensityKind::SymmetricDirichlet.into(),
            barrier,
            ..Model::default()
        };
        for problem in [spiral(1.2, &model), spiral(2.2, &model), arch(&model)] {
            let mut problem = collapsed(problem);
            problem.untangle_start().expect("a valid start");
            assert!(problem.untangled > 0);
            assert_held(&problem, &problem.start);
            assert_reached(&problem, &solved(&problem));
        }
    }
}

#[test]
fn a_free_border_takes_no_start_at_the_targets() {
    // Two corners that change places: nothing but the paths of the handles says how.
    let body = Body::from(&sheet(4));
    let corners = [(0, [4.0, 4.0]), (24, [0.0, 0.0])];
    let handles = corners.map(|(vertex, to)| Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    });
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    assert_reached(&problem, &solved(&problem));
}
