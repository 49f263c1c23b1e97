//! The loops of the solver allocate nothing: counted over the whole process, from one iterate to the next.

#[path = "support/bodies.rs"]
mod bodies;

use std::sync::{Barrier, Mutex};

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use rayon::{ThreadPool, ThreadPoolBuilder};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use unwrapd_deform::{Body, Handle, Model, Problem};
use unwrapd_maps::embed::{Options, parameterize};
use unwrapd_maps::mesh::{Disk, PlanarMesh};
use unwrapd_method::solver::{Control, Iterate, Settings, Watch};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// Allocations in each iteration, those at the start of a minimization left out, of a body whose first vertex stays, whose last
/// is pulled away by half of its length, and in which a point is pulled too.
fn allocations(body: Body, pool: &ThreadPool) -> Vec<usize> {
    let dim = body.dim();
    let last = body.rest.len() - dim;
    let length = body.rest[last];
    let handles = [
        Handle::Vertex {
            vertex: 0,
            to: body.rest[..dim].to_vec(),
            weight: None,
        },
        Handle::Vertex {
            vertex: (last / dim) as u32,
            to: body.rest[last..].iter().map(|x| 1.5 * x).collect(),
            weight: None,
        },
        Handle::Point {
            at: (0..dim)
                .map(|k| (0.41 + 0.02 * k as f64) * length)
                .collect(),
            to: (0..dim).map(|k| (0.5 + 0.02 * k as f64) * length).collect(),
            weight: None,
        },
    ];
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    counted(pool, |watch| {
        let solution = problem.solve(&Settings::follow(), watch).expect("solved");
        assert_eq!(solution.quality.inverted, 0);
    })
}

/// Allocations in each iteration of mapping a bent sheet, which ends within a trust region.
fn chart_allocations(sheet: &PlanarMesh, pool: &ThreadPool) -> Vec<usize> {
    let disk = Disk::new(sheet.vertices().len(), sheet.triangles().to_vec()).expect("a disk");
    let bent = |&[x, y]: &[f64; 2]| [x, y, 20.0 * (0.13 * x).sin() * (0.11 * y).cos()];
    let positions: Vec<[f64; 3]> = sheet.vertices().iter().map(bent).collect();
    let options = Options {
        solver: Settings::exact(),
        ..Options::default()
    };
    counted(pool, |watch| {
        let summary = parameterize(&disk, &positions, &options, watch).summary;
        // So it was in the trust region, where one factorization serves several directions.
        assert!(summary.factorizations < summary.iterations, "{summary:?}");
    })
}

/// Allocations from one iterate to the next while `work` is watched.
fn counted(pool: &ThreadPool, work: impl FnOnce(&dyn Watch) + Send) -> Vec<usize> {
    pool.install(|| {
        let region = Region::new(ALLOCATOR);
        let seen = Mutex::new(Vec::with_capacity(10_000));
        let watch = |i: &Iterate| {
            let change = region.change();
            let count = change.allocations + change.reallocations;
            seen.lock().expect("unpoisoned").push((i.iteration, count));
            Control::Continue
        };
        work(&watch);
        let seen = seen.into_inner().expect("unpoisoned");
        // A minimization begins by showing again where the one before ended.
        let iterations = seen.windows(2).filter(|w| w[1].0 > w[0].0);
        iterations.map(|w| w[1].1 - w[0].1).collect()
    })
}

/// Threads that have worked already: each allocates when it takes work, and when it multiplies matrices, for the first time; and
/// when it ends.
fn pool(n_threads: usize) -> ThreadPool {
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
    let pool = pool.expect("threads");
    let everyone = Barrier::new(n_threads);
    pool.scope(|scope| {
        for _ in 0..n_threads {
            scope.spawn(|_| {
                everyone.wait();
                let matrix = Mat::<f64>::identity(500, 500);
                let mut product = Mat::zeros(500, 500);
                matmul(
                    &mut product,
                    Accum::Replace,
                    &matrix,
                    &matrix,
                    1.0,
                    Par::Seq,
                );
                assert_eq!(product, matrix);
            });
        }
    });
    pool
}

/// The first iteration may fill what is kept from then on.
fn assert_none(name: &str, counts: &[usize]) {
    assert!(counts.len() > 5, "{name}: {} iterations", counts.len());
    assert!(counts[1..].iter().all(|&n| n == 0), "{name}: {counts:?}");
}

/// One test, so that nothing else runs in the process.
#[test]
fn iterations_allocate_nothing() {
    let pools = [1, 2].map(pool);
    for pool in &pools {
        let sheet = bodies::sheet(100);
        assert_none("chart", &chart_allocations(&sheet, pool));
        assert_none("sheet", &allocations(Body::from(&sheet), pool));
        // Has fronts of more than 320 rows, which go through faer's products.
        let block = Body::from(&bodies::block(10));
        assert_none("block", &allocations(block, pool));
    }
}
