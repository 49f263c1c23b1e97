//! Targets that contradict every map without inversions: refused or named at once, and nothing else is.

use std::f64::consts::{PI, TAU};

use unwrapd_deform::{Body, Handle, Model, Problem, ProblemError, Solution};
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::bodies::{block, sheet};

/// Vertices on each ring of a disk or an annulus.
const AROUND: u32 = 48;

/// Rings of vertices at radii 1, 2, …, `rings`; a disk with a vertex in the middle, or an annulus. No element has all
/// its corners on the border.
fn rings(rings: u32, has_middle: bool) -> Body {
    let at = |v: u32| {
        let (radius, angle) = (
            f64::from(v / AROUND + 1),
            TAU * f64::from(v % AROUND) / f64::from(AROUND),
        );
        [radius * angle.cos(), radius * angle.sin()]
    };
    let mut vertices: Vec<[f64; 2]> = (0..rings * AROUND).map(at).collect();
    let id = |ring: u32, k: u32| ring * AROUND + k % AROUND;
    let cells = (0..rings - 1).flat_map(|ring| (0..AROUND).map(move |k| (ring, k)));
    let mut triangles: Vec<[u32; 3]> = cells
        .flat_map(|(ring, k)| {
            let [a, b, c, d] = [
                id(ring, k),
                id(ring + 1, k),
                id(ring + 1, k + 1),
                id(ring, k + 1),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    if has_middle {
        let middle = vertices.len() as u32;
        vertices.push([0.0, 0.0]);
        triangles.extend((0..AROUND).map(|k| [middle, id(0, k), id(0, k + 1)]));
    }
    Body::from(&PlanarMesh::new(vertices, triangles).expect("rings"))
}

/// The vertices of a ring, counted from the innermost.
fn ring(number: u32) -> Vec<u32> {
    (number * AROUND..(number + 1) * AROUND).collect()
}

/// Returns a problem that holds these vertices of a body at the images of their rest positions.
fn held<const D: usize>(
    body: &Body,
    vertices: &[u32],
    image: impl Fn([f64; D]) -> [f64; D],
) -> Problem {
    held_with(body, vertices, image, &Model::default())
}

fn held_with<const D: usize>(
    body: &Body,
    vertices: &[u32],
    image: impl Fn([f64; D]) -> [f64; D],
    model: &Model,
) -> Problem {
    let handle = |&vertex: &u32| {
        let place: [f64; D] = std::array::from_fn(|k| body.rest[D * vertex as usize + k]);
        let to = image(place).to_vec();
        Handle::Vertex {
            vertex,
            to,
            weight: None,
        }
    };
    let handles: Vec<Handle> = vertices.iter().map(handle).collect();
    Problem::new(body.clone(), &handles, model).expect("a problem")
}

fn solved(problem: &Problem) -> Result<Solution, ProblemError> {
    problem.solve(&Settings::follow(), &|_: &Iterate| Control::Continue)
}

/// Returns the stable code of the refusal.
fn refusal(problem: &Problem) -> &'static str {
    let refused = solved(problem).map(|solution| solution.summary);
    refused.expect_err("a refusal").code()
}

#[test]
fn an_element_that_its_targets_invert_or_flatten_is_refused() {
    let body = Body::from(&sheet(8));
    let triangle = [30, 31, 40];
    let cases: [fn([f64; 2]) -> [f64; 2]; 3] =
        [|[x, y]| [-x, y], |[x, _]| [x, 0.0], |_| [0.1, 0.2]];
    for image in cases {
        assert_eq!(
            refusal(&held(&body, &triangle, image)),
            "held_element_inverted"
        );
    }
    // The ends of an edge alone, and in space three corners on a line and four in a plane.
    let edge = held(&body, &triangle[..2], |_: [f64; 2]| [3.5, 3.0]);
    assert_eq!(refusal(&edge), "held_element_inverted");
    let body = Body::from(&block(2));
    let tet = [0, 1, 4, 13];
    let line = held(&body, &tet[..3], |[x, y, _]: [f64; 3]| [2.0 * x + y; 3]);
    assert_eq!(refusal(&line), "held_element_inverted");
    let plane = held(&body, &tet, |[x, y, _]: [f64; 3]| [x, y, x + y]);
    assert_eq!(refusal(&plane), "held_element_inverted");
}

#[test]
fn a_boundary_without_a_positive_size_is_refused() {
    let disk = rings(3, true);
    let cases: [fn([f64; 2]) -> [f64; 2]; 2] = [
        |[x, y]| [y, x],
        // A figure of eight whose loops are equal.
        |[x, y]| [x, x * y],
    ];
    for image in cases {
        assert_eq!(refusal(&held(&disk, &ring(2), image)), "boundary_inverted");
    }
}

#[test]
fn a_border_that_turns_too_little_is_refused() {
    // A figure of eight with one loop larger than the other has a positive area, but its turning is zero.
    let disk = rings(3, true);
    let eight = |[x, y]: [f64; 2]| {
        let angle = y.atan2(x);
        let loops = if x > 0.0 { 2.0 } else { 1.0 };
        [loops * angle.cos(), loops * (2.0 * angle).sin()]
    };
    assert_eq!(
        refusal(&held(&disk, &ring(2), eight)),
        "boundary_turns_too_little"
    );
    // Around a hole the border makes no turn in all: the same rings as an annulus are accepted.
    let annulus = rings(3, false);
    let both = [ring(0), ring(2)].concat();
    let solution = solved(&held(&annulus, &both, |[x, y]: [f64; 2]| [-y, x])).expect("a turn");
    assert_eq!(solution.summary.status, Status::Converged);
}

#[test]
fn a_border_may_overlap_itself() {
    // A strip of three layers bent by one turn and a half: no winding or turning speaks against it.
    let row = 61;
    let vertices = (0..4 * row).map(|v| [f64::from(v % row), f64::from(v / row)]);
    let cells = (0..3 * (row - 1)).map(|c| c / (row - 1) * row + c % (row - 1));
    let triangles = cells.flat_map(|a| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
    let strip = PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a strip");
    let body = Body::from(&strip);
    let is_border = |v: &u32| [0, row - 1].contains(&(v % row)) || [0, 3].contains(&(v / row));
    let border: Vec<u32> = (0..4 * row).filter(is_border).collect();
    let bent = |[x, y]: [f64; 2]| {
        let (radius, angle) = (5.0 + y, -3.0 * PI * x / f64::from(row - 1));
        [radius * angle.cos(), radius * angle.sin()]
    };
    let solution = solved(&held(&body, &border, bent)).expect("targets that can be reached");
    assert_eq!(
        (solution.summary.status, solution.quality.inverted),
        (Status::Converged, 0)
    );
}

#[test]
fn what_the_border_does_not_surround_is_named_at_once_and_holds_back_nothing_else() {
    let disk = rings(6, true);
    let middle = 6 * AROUND;
    let outer = ring(5);
    let mut vertices = [outer.clone(), vec![middle, 0, AROUND / 2]].concat();
    let to = |place: [f64; 2]| move |p: [f64; 2]| if p == [0.0, 0.0] { place } else { p };
    // Outside, and at the place of another held vertex.
    for (place, reached) in [([9.0, 1.0], 2), ([1.0, 0.0], 2)] {
        let problem = held(&disk, &vertices, to(place));
        let solution = solved(&problem).expect("a map");
        assert_eq!(solution.summary.status, Status::TargetsUnreachable);
        assert_eq!(solution.quality.inverted, 0);
        assert!(solution.summary.iterations < 100, "{:?}", solution.summary);
        let unreached = problem.unreached(&solution);
        assert_eq!(unreached.len(), 3 - reached, "{unreached:?}");
    }
    // Within the border the same vertex arrives.
    vertices.truncate(outer.len() + 1);
    let solution = solved(&held(&disk, &vertices, to([2.0, 1.0]))).expect("a map");
    assert_eq!(solution.summary.status, Status::Converged);
}

#[test]
fn targets_beyond_the_arithmetic_are_refused() {
    let body = Body::from(&sheet(4));
    for far in [1e155, 1e300] {
        let problem = held(
            &body,
            &[0, 24],
            |[x, y]: [f64; 2]| if x > 0.0 { [far, y] } else { [x, y] },
        );
        assert_eq!(refusal(&problem), "bad_target");
    }
}

#[test]
fn maps_that_may_invert_are_not_judged() {
    let body = Body::from(&sheet(4));
    let model = Model {
        barrier: BarrierKind::None,
        ..Model::default()
    };
    let triangle = [6, 7, 12];
    let problem = held_with(&body, &triangle, |[x, y]: [f64; 2]| [-x, y], &model);
    let solution = solved(&problem).expect("a map with inversions");
    assert_eq!(solution.summary.status, Status::Converged);
}
