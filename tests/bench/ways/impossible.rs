//! A handle that cannot be reached, beside four that can.

use unwrapd::deform::{Body, Handle, Model, Problem};
use unwrapd::solver::Settings;

use crate::bodies::{block, sheet};
use crate::clock::Clock;
use crate::go_on;

/// A square whose border is held, and five handles in it, the first of which is to leave it.
pub fn plane() -> (Body, Vec<Handle>) {
    const CELLS: u32 = 60;
    let id = |[x, y]: [u32; 2]| y * (CELLS + 1) + x;
    let mut handles = vec![vertex(id([30, 10]), &[30.0, -15.0])];
    for (at, to) in [
        ([15, 20], [20.0, 30.0]),
        ([45, 20], [42.0, 31.0]),
        ([15, 45], [24.0, 46.0]),
        ([45, 45], [45.0, 36.0]),
    ] {
        handles.push(vertex(id(at), &to));
    }
    let body = Body::from(&sheet(CELLS));
    handles.extend(border(&body, CELLS));
    (body, handles)
}

/// The same in a cube.
pub fn space() -> (Body, Vec<Handle>) {
    const CELLS: u32 = 12;
    const ROW: u32 = CELLS + 1;
    let id = |[x, y, z]: [u32; 3]| (z * ROW + y) * ROW + x;
    let mut handles = vec![vertex(id([6, 6, 2]), &[6.0, 6.0, -3.0])];
    for (at, to) in [
        ([3, 3, 6], [4.0, 4.0, 7.0]),
        ([9, 3, 6], [8.0, 4.0, 6.0]),
        ([3, 9, 6], [4.0, 9.0, 7.5]),
        ([9, 9, 6], [9.0, 8.0, 5.0]),
    ] {
        handles.push(vertex(id(at), &to));
    }
    let body = Body::from(&block(CELLS));
    handles.extend(border(&body, CELLS));
    (body, handles)
}

/// Handles that hold the border of a sheet or a block of so many cells along a side.
fn border(body: &Body, cells: u32) -> Vec<Handle> {
    let places = body.rest.chunks_exact(body.dim()).zip(0..);
    let is_side = |x: &f64| *x == 0.0 || *x == f64::from(cells);
    let held = places.filter(|(place, _)| place.iter().any(is_side));
    held.map(|(place, v)| vertex(v, place)).collect()
}

fn vertex(vertex: u32, to: &[f64]) -> Handle {
    Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    }
}

/// Five handles in a body whose border is held, the first of which cannot be reached.
pub fn impossible((body, handles): (Body, Vec<Handle>)) {
    let dim = body.dim();
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    let clock = Clock::start();
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a problem");
    let seconds = clock.seconds().processor;
    let unreached = problem.unreached(&solution);
    let distance = |handle: &Handle| match handle {
        Handle::Vertex { vertex, to, .. } => {
            let place = &solution.x[dim * *vertex as usize..];
            let squares = place.iter().zip(to).map(|(x, t)| (x - t) * (x - t));
            squares.sum::<f64>().sqrt()
        }
        _ => f64::NAN,
    };
    let easy: Vec<f64> = handles[1..5].iter().map(distance).collect();
    println!(
        "impossible in {dim} dimensions: {:?}, {} iterations, {} factorizations, {seconds:.2} s, {} inverted, unreached {unreached:?}, \
         the easy ones by {easy:?}",
        solution.summary.status,
        solution.summary.iterations,
        solution.summary.factorizations,
        solution.quality.inverted
    );
    assert!(unreached.len() == 1 && unreached[0].handle == 0);
}
