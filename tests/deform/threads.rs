//! The same bits for any number of threads, on a chart and on a solid large enough for all of them to have work.

use std::sync::Arc;

use rayon::ThreadPoolBuilder;
use unwrapd_deform::cage::{Cage, CagedSurface};
use unwrapd_deform::{Body, Handle, Model, Problem};
use unwrapd_maps::embed::{Options, parameterize};
use unwrapd_maps::mesh::Disk;
use unwrapd_method::energy::SymmetricDirichlet;
use unwrapd_method::solver::{Control, Iterate, Settings};

/// What `work` gives with one thread, after comparing it with what it gives with two.
#[track_caller]
fn assert_same<T: PartialEq + Send>(work: impl Fn() -> T + Sync) -> T {
    let with = |n_threads| {
        let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
        pool.expect("threads").install(&work)
    };
    let alone = with(1);
    assert!(alone == with(2), "two threads differ");
    alone
}

#[test]
fn a_chart_is_the_same_with_two_threads() {
    const SIDE: u32 = 120;
    let n = SIDE + 1;
    let positions: Vec<[f64; 3]> = (0..n * n)
        .map(|v| {
            let [x, y] = [v % n, v / n].map(|i| f64::from(i) / f64::from(SIDE));
            [x, y, (7.0 * x).sin() * (5.0 * y).cos()]
        })
        .collect();
    let squares = (0..SIDE * SIDE).map(|s| s / SIDE * n + s % SIDE);
    let triangles = squares.flat_map(|a| [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]);
    let disk = Disk::new(positions.len(), triangles.collect()).expect("a disk");
    let options = Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    };
    let map = assert_same(|| {
        parameterize(&disk, &positions, &options, &|_: &Iterate| {
            Control::Continue
        })
    });
    assert!(map.summary.iterations > 0);
}

#[test]
fn a_solid_is_the_same_with_two_threads() {
    // A box in a cage of 12 × 12 × 12 cubes.
    let positions: Vec<[f64; 3]> = (0..8)
        .map(|v| [v & 1, v >> 1 & 1, v >> 2].map(f64::from))
        .collect();
    let triangles = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let surface = CagedSurface {
        positions: &positions,
        triangles: &triangles,
    };
    let cage = Cage::around(&[surface], 10).expect("a cage");
    let end = |z: f64, to: f64| Handle::Disc {
        center: vec![0.5, 0.5, z],
        radius: 0.4,
        to: vec![0.5, 0.5 + to, z],
        turn: 0.0,
        axis: None,
        weight: None,
    };
    let body = Body::from(cage.mesh());
    let problem = Problem::new(body, &[end(0.0, 0.0), end(1.0, 0.5)], &Model::default());
    let problem = problem.expect("a problem");
    let solution = assert_same(|| {
        let solved = problem.solve(&Settings::follow(), &|_: &Iterate| Control::Continue);
        let solved = solved.expect("an energy of space");
        (solved.x, solved.summary)
    });
    assert!(solution.1.iterations > 0);
}
