//! The loops of the solver allocate nothing: counted over the whole process, from one iterate to the next.

use std::cell::RefCell;

use rayon::ThreadPoolBuilder;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use unwrapd::deform::{Body, Handle, Model, Problem};
use unwrapd::mesh::{PlanarMesh, TetMesh};
use unwrapd::solver::{Control, Iterate, Settings};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// A sheet of `n` by `n` squares, two triangles each.
fn sheet(n: u32) -> Body {
    let row = n + 1;
    let vertices = (0..row * row).map(|v| [f64::from(v % row), f64::from(v / row)]);
    let squares = (0..n * n).map(|s| s / n * row + s % n);
    let triangles = squares.flat_map(|a| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
    Body::from(&PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a sheet"))
}

/// A block of `n` × `n` × `n` cubes, six tetrahedra each.
fn block(n: u32) -> Body {
    let row = n + 1;
    let id = |[x, y, z]: [u32; 3]| x + row * (y + row * z);
    let vertices = (0..row * row * row).map(|v| [v % row, v / row % row, v / (row * row)]);
    let axes = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let tets = (0..n * n * n).flat_map(|c| {
        axes.map(|order| {
            let mut corner = [c % n, c / n % n, c / (n * n)];
            let mut tet = [id(corner); 4];
            for (place, axis) in tet[1..].iter_mut().zip(order) {
                corner[axis] += 1;
                *place = id(corner);
            }
            tet
        })
    });
    let vertices = vertices.map(|p| p.map(f64::from)).collect();
    Body::from(&TetMesh::new(vertices, tets.collect()).expect("a block"))
}

/// Allocations in each iteration, those at the start of a minimization left out, of a body whose first vertex stays, whose last is pulled away by half of its length, and
/// in which a point is pulled too.
fn allocations(body: Body, n_threads: usize) -> Vec<usize> {
    let dim = body.dim();
    let last = body.rest.len() - dim;
    let length = body.rest[last];
    let handles = [
        Handle::Vertex {
            vertex: 0,
            to: body.rest[..dim].to_vec(),
        },
        Handle::Vertex {
            vertex: (last / dim) as u32,
            to: body.rest[last..].iter().map(|x| 1.5 * x).collect(),
        },
        Handle::Point {
            at: (0..dim)
                .map(|k| (0.41 + 0.02 * k as f64) * length)
                .collect(),
            to: (0..dim).map(|k| (0.5 + 0.02 * k as f64) * length).collect(),
        },
    ];
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
    pool.expect("threads").install(|| {
        let region = Region::new(ALLOCATOR);
        let seen = RefCell::new(Vec::with_capacity(10_000));
        let watch = |i: &Iterate| {
            let change = region.change();
            let count = change.allocations + change.reallocations;
            seen.borrow_mut().push((i.iteration, count));
            Control::Continue
        };
        let solution = problem.solve(&Settings::follow(), &watch).expect("solved");
        assert_eq!(solution.worth.inverted, 0);
        let seen = seen.into_inner();
        // A minimization begins by showing again where the one before ended.
        let iterations = seen.windows(2).filter(|w| w[1].0 > w[0].0);
        iterations.map(|w| w[1].1 - w[0].1).collect()
    })
}

/// One test, so that nothing else runs in the process.
#[test]
fn iterations_allocate_nothing() {
    for n_threads in [1, 2] {
        // The block has fronts of more than 320 rows, which go through faer's products.
        for (name, body) in [("sheet", sheet(100)), ("block", block(10))] {
            let counts = allocations(body, n_threads);
            assert!(counts.len() > 5, "{name}: {} iterations", counts.len());
            // The first iteration may fill what is kept from then on.
            assert!(
                counts[1..].iter().all(|&n| n == 0),
                "{name}, {n_threads} threads: {counts:?}"
            );
        }
    }
}
