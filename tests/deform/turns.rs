//! Discs that turn by any angle, and how many of the turns a map holds.

use std::f64::consts::TAU;

use unwrapd_deform::{Body, Handle, Model, Problem, Turns};
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::pulled::{bar, strip};

const LENGTH: u32 = 24;

fn ball(x: f64, to: f64, turn: f64) -> Handle {
    Handle::Disc {
        center: vec![x, 0.5, 0.5],
        radius: 0.8,
        to: vec![to, 0.5, 0.5],
        turn,
        axis: (turn != 0.0).then_some([2.0, 0.0, 0.0]),
        weight: None,
    }
}

/// A bar whose ends are held, turned, and brought to places along it.
fn twisted(near: (f64, f64), far: (f64, f64)) -> Problem {
    let end = f64::from(LENGTH);
    let handles = [ball(0.0, near.0, near.1), ball(end, far.0, far.1)];
    Problem::new(Body::from(&bar(LENGTH)), &handles, &Model::default()).expect("handles of the bar")
}

/// The bar as a screw of so many turns, right-handed about the x axis.
fn screw(problem: &Problem, turns: f64) -> Vec<f64> {
    let places = problem.body.rest.as_chunks::<3>().0.iter();
    let turned = places.flat_map(|&[x, y, z]| {
        let (sin, cos) = (TAU * turns * x / f64::from(LENGTH)).sin_cos();
        let [y, z] = [y - 0.5, z - 0.5];
        [x, 0.5 + cos * y - sin * z, 0.5 + sin * y + cos * z]
    });
    turned.collect()
}

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn sole(turns: &[Turns]) -> Turns {
    assert_eq!(turns.len(), 1, "{turns:?}");
    turns[0]
}

#[test]
fn a_stretched_bar_keeps_all_turns_of_its_end() {
    let problem = twisted((0.0, 0.0), (1.4 * f64::from(LENGTH), 1080.0));
    assert_eq!(problem.stations.len(), 72);
    let solution = problem.solve(&Settings::follow(), &go_on);
    let solution = solution.expect("an energy of space");
    assert_eq!(solution.summary.status, Status::Converged);
    assert_eq!(solution.quality.inverted, 0);
    assert!(solution.quality.residual < 1e-24);
    let turns = sole(&problem.turns(&solution.x));
    assert_eq!((turns.handle, turns.asked), (1, 3.0));
    // The bar bends a little.
    assert!((turns.left - 3.0).abs() < 0.05, "{turns:?}");
    assert!(!turns.are_lost());
}

#[test]
fn turns_are_counted_from_positions() {
    let problem = twisted((0.0, 0.0), (24.0, 1440.0));
    for held in [4.0, 3.4, 2.0, 0.0, -1.0] {
        let turns = sole(&problem.turns(&screw(&problem, held)));
        assert!((turns.left - held).abs() < 1e-9, "{turns:?} of {held}");
        assert_eq!(turns.asked, 4.0);
        assert_eq!(turns.are_lost(), held < 3.6);
    }
    // Neither where the bar lies, nor how it stands, nor its size matters: x, y, z become z, x, y.
    let screwed = screw(&problem, 4.0);
    let places = screwed.as_chunks::<3>().0.iter();
    let moved: Vec<f64> = places
        .flat_map(|&[x, y, z]| [z, x, y].map(|x| 9.0 + 3.0 * x))
        .collect();
    let turns = sole(&problem.turns(&moved));
    assert!((turns.left - 4.0).abs() < 1e-9, "{turns:?}");
}

#[test]
fn both_ends_may_turn() {
    let problem = twisted((0.0, -360.0), (24.0, 540.0));
    assert_eq!(problem.stations.len(), 36);
    let turns = problem.turns(&screw(&problem, 2.5));
    let [near, far] = turns[..] else {
        panic!("{turns:?}");
    };
    assert_eq!([near.asked, far.asked], [-2.5, 2.5]);
    assert!(
        (near.left + 2.5).abs() < 1e-9 && (far.left - 2.5).abs() < 1e-9,
        "{turns:?}"
    );
    let together = twisted((0.0, 720.0), (24.0, 720.0));
    assert_eq!(together.turns(&together.start), []);
}

#[test]
fn half_a_turn_goes_to_the_side_it_is_told() {
    for turn in [180.0, -180.0] {
        let problem = twisted((0.0, 0.0), (24.0, turn));
        let solution = problem.solve(&Settings::follow(), &go_on);
        let turns = sole(&problem.turns(&solution.expect("an energy of space").x));
        assert!((turns.left - turn / 360.0).abs() < 0.01, "{turns:?}");
    }
    let problem = twisted((0.0, 0.0), (24.0, 120.0));
    assert_eq!(problem.stations.len(), 1);
    assert_eq!(problem.turns(&problem.start), []);
}

#[test]
fn a_strip_of_the_plane_curls() {
    let disc = |x: f64, to: f64, turn: f64| Handle::Disc {
        center: vec![x, 1.0],
        radius: 1.0,
        to: vec![to, 1.0],
        turn,
        axis: None,
        weight: None,
    };
    let handles = [disc(0.0, 0.0, 0.0), disc(40.0, 10.0, 720.0)];
    let problem = Problem::new(Body::from(&strip(40, 1.0)), &handles, &Model::default());
    let problem = problem.expect("handles of the strip");
    let solution = problem.solve(&Settings::follow(), &go_on);
    let solution = solution.expect("an energy of the plane");
    assert_eq!(solution.summary.status, Status::Converged);
    let turns = sole(&problem.turns(&solution.x));
    assert_eq!(turns.asked, 2.0);
    assert!((turns.left - 2.0).abs() < 1e-6, "{turns:?}");
}

#[test]
fn a_disc_in_a_fixed_border_keeps_its_turns_however_sheared() {
    // Rings turned by so much that a ring is sheared beside the next by more than half a turn.
    let side = 48;
    let vertices =
        (0..(side + 1) * (side + 1)).map(|v| [v % (side + 1), v / (side + 1)].map(f64::from));
    let triangles = (0..side * side).flat_map(|cell| {
        let a = cell / side * (side + 1) + cell % side;
        [[a, a + 1, a + side + 2], [a, a + side + 2, a + side + 1]]
    });
    let mesh = PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a grid");
    let middle = f64::from(side) / 2.0;
    let border = (0..(side + 1) * (side + 1)).filter(|v| {
        let [x, y] = [v % (side + 1), v / (side + 1)];
        x == 0 || y == 0 || x == side || y == side
    });
    let held = border.map(|vertex| Handle::Vertex {
        vertex,
        to: mesh.vertices()[vertex as usize].to_vec(),
        weight: None,
    });
    let disc = Handle::Disc {
        center: vec![middle; 2],
        radius: 7.0,
        to: vec![middle; 2],
        turn: 720.0,
        axis: None,
        weight: None,
    };
    let handles: Vec<Handle> = held.chain([disc]).collect();
    let problem = Problem::new(Body::from(&mesh), &handles, &Model::default()).expect("handles");
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("an energy of the plane");
    assert_eq!(solution.quality.inverted, 0);
    let turns = sole(&problem.turns(&solution.x));
    assert_eq!(turns.asked, 2.0);
    assert!((turns.left - 2.0).abs() < 1e-9, "{turns:?}");
}

#[test]
fn a_turn_needs_an_axis_in_space_and_has_none_in_the_plane() {
    let code = |body: Body, turn: f64, axis: Option<[f64; 3]>| {
        let dim = body.dim();
        let handle = Handle::Disc {
            center: vec![0.0; dim],
            radius: 1.0,
            to: vec![0.0; dim],
            turn,
            axis,
            weight: None,
        };
        let made = Problem::new(body, &[handle], &Model::default());
        made.map_or_else(|error| error.code(), |_| "made")
    };
    let (solid, flat) = (|| Body::from(&bar(2)), || Body::from(&strip(2, 1.0)));
    assert_eq!(code(solid(), 30.0, Some([0.0, 0.0, 1.0])), "made");
    assert_eq!(code(solid(), 0.0, None), "made");
    assert_eq!(code(flat(), -36_000.0, None), "made");
    for refused in [
        code(solid(), 30.0, None),
        code(solid(), 30.0, Some([0.0; 3])),
        code(solid(), 30.0, Some([f64::NAN, 0.0, 0.0])),
        code(solid(), f64::INFINITY, Some([0.0, 0.0, 1.0])),
        code(flat(), 30.0, Some([0.0, 0.0, 1.0])),
        code(flat(), 36_001.0, None),
    ] {
        assert_eq!(refused, "bad_parameter");
    }
}
