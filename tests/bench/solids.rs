//! Solids pulled by handles, and what one iteration of a session costs.
//!
//! `cargo bench --bench solids -- [CASE …]`; without arguments all: `armadillo` (55,000 tetrahedra of a file), `cage-N` (koala in a
//! cage of N voxels along its longest side: 27 give 13,000 tetrahedra, 57 give 100,000, 100 give 500,000), `plane-N` (N×N
//! squares, two triangles each). One end is held; the other is turned by a right angle and shifted by a tenth of the length, in
//! cages shifted by a fifth. Prints iterations, factorizations, seconds and peak memory for Green's energy and for ARAP, both with
//! the barrier, and then the milliseconds on the wall of the parts of one iteration at the solution. What cages spend on coarser
//! cages is in the seconds before the first iterate.

mod clock;
#[expect(
    dead_code,
    reason = "solids are not subdivided, nor read from a folder"
)]
mod meshes;

use std::hint::black_box;

use clock::{Clock, Seconds, peak_megabytes};
use unwrapd::deform::cage::{Cage, Caged, CagedSurface};
use unwrapd::deform::{Body, Handle, Model, Problem, Solution};
use unwrapd::energy::{DensityKind, EnergyKind};
use unwrapd::io::gmsh;
use unwrapd::mesh::{PlanarMesh, TetMesh};
use unwrapd::solver::{Control, Iterate, Objective, Settings};

/// Without arguments.
const CASES: [&str; 6] = [
    "plane-50",
    "plane-158",
    "armadillo",
    "cage-27",
    "cage-57",
    "cage-100",
];

/// Share of the longest side that is held at either end.
const HELD: f64 = 0.08;

fn main() {
    let mut cases: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if cases.is_empty() {
        cases = CASES.map(str::to_owned).to_vec();
    }
    for case in cases {
        for energy in [DensityKind::Green.into(), DensityKind::Arap.into()] {
            report(&case, &energy);
        }
    }
}

fn body(case: &str) -> Body {
    let number = case.rsplit('-').next().and_then(|n| n.parse().ok());
    match number {
        None => Body::from(&armadillo()),
        Some(n) => Body::from(&plane(n)),
    }
}

/// The body of a case, pulled by its ends. A cage starts where a coarser one ends.
fn problem(case: &str, model: &Model) -> Problem {
    let Some(n_voxels) = case.strip_prefix("cage-") else {
        let body = body(case);
        let handles = handles(&body);
        return Problem::new(body, &handles, model).expect("a problem");
    };
    let n_voxels = n_voxels.parse().expect("a number of voxels");
    let surface = meshes::read(&meshes::path("closed/koala.obj")).expect("a surface");
    let surfaces = [CagedSurface {
        positions: &surface.positions,
        triangles: &surface.triangles,
    }];
    let cage = Cage::around(&surfaces, n_voxels).expect("a cage");
    let handles = ends(&surface.positions);
    let mut problem = Problem::new(Body::from(cage.mesh()), &handles, model).expect("a problem");
    let caged = Caged {
        surfaces: &surfaces,
        handles: &handles,
        model,
    };
    caged.start(&mut problem, &cage, n_voxels, &|_: &Iterate| {
        Control::Continue
    });
    problem
}

/// Balls at the two ends of a surface along its longest axis; one is shifted across it, by a fifth of its length.
fn ends(positions: &[[f64; 3]]) -> [Handle; 2] {
    let bound = |k: usize, pick: fn(f64, f64) -> f64, from: f64| {
        positions.iter().map(|p| p[k]).fold(from, pick)
    };
    let low = [0, 1, 2].map(|k| bound(k, f64::min, f64::INFINITY));
    let high = [0, 1, 2].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
    let size = [0, 1, 2].map(|k| high[k] - low[k]);
    let longest = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    let end = |most: bool, shift: f64| {
        let distance = |p: &[f64; 3]| {
            if most {
                high[longest] - p[longest]
            } else {
                p[longest] - low[longest]
            }
        };
        let nearest = positions
            .iter()
            .min_by(|p, q| distance(p).total_cmp(&distance(q)));
        let center = *nearest.expect("a surface");
        let mut to = center;
        to[(longest + 1) % 3] += shift * size[longest];
        Handle::Disc {
            center: center.to_vec(),
            radius: 2.0 * HELD * size[longest],
            to: to.to_vec(),
            turn: 0.0,
            axis: None,
            weight: None,
        }
    };
    [end(false, 0.0), end(true, 0.2)]
}

fn armadillo() -> TetMesh {
    let bytes = std::fs::read(meshes::path("tet/Armadillo13K.msh")).expect("test data");
    let elements = gmsh::read(&bytes).expect("a mesh");
    elements.into_tet_mesh().expect("tetrahedra")
}

/// A sheet of `n` by `n` unit squares.
fn plane(n: u32) -> PlanarMesh {
    let index = |i: u32, j: u32| i * (n + 1) + j;
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| [f64::from(i), f64::from(j)]));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            index(i, j),
            index(i + 1, j),
            index(i + 1, j + 1),
            index(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a sheet")
}

/// The two ends of the body along its longest axis.
fn handles(body: &Body) -> Vec<Handle> {
    let dim = body.dim();
    let points: Vec<&[f64]> = body.rest.chunks_exact(dim).collect();
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, from: f64| {
        points.iter().map(|p| p[axis]).fold(from, pick)
    };
    let low: Vec<f64> = (0..dim)
        .map(|k| bound(k, f64::min, f64::INFINITY))
        .collect();
    let high: Vec<f64> = (0..dim)
        .map(|k| bound(k, f64::max, f64::NEG_INFINITY))
        .collect();
    let longest = (0..dim)
        .max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b])))
        .expect("an axis");
    let length = high[longest] - low[longest];
    // In the plane the end turns in it, in space about the axis.
    let turned = if dim == 2 {
        [longest, 1 - longest]
    } else {
        [(longest + 1) % 3, (longest + 2) % 3]
    };
    let center = |k: usize| {
        if k == longest {
            high[k]
        } else {
            0.5 * (low[k] + high[k])
        }
    };
    let place = |p: &[f64]| {
        let along = (p[longest] - low[longest]) / length;
        if along <= HELD {
            return Some(p.to_vec());
        }
        let [a, b] = turned;
        (along >= 1.0 - HELD).then(|| {
            let mut to = p.to_vec();
            (to[a], to[b]) = (
                center(a) - (p[b] - center(b)),
                center(b) + (p[a] - center(a)),
            );
            to[b] += 0.1 * length;
            to
        })
    };
    let numbered = (0..).zip(&points);
    numbered
        .filter_map(|(vertex, p)| {
            place(p).map(|to| Handle::Vertex {
                vertex,
                to,
                weight: None,
            })
        })
        .collect()
}

fn report(case: &str, energy: &EnergyKind) {
    let model = Model {
        energy: energy.clone(),
        ..Model::default()
    };
    forget_peak();
    let clock = Clock::start();
    let problem = problem(case, &model);
    let body = &problem.body;
    let n_elements = body.determinants().len();
    let first = std::cell::Cell::new(None);
    let watch = |_: &Iterate| {
        if first.get().is_none() {
            first.set(Some(clock.seconds().processor));
        }
        Control::Continue
    };
    let solution = problem
        .solve(&Settings::follow(), &watch)
        .expect("a problem that can be solved");
    let Seconds { wall, processor } = clock.seconds();
    let summary = &solution.summary;
    println!(
        "{case} {energy:?}: {n_elements} elements, {} vertices, {:?}, {} iterations, {} factorizations, {wall:.2} s, \
         {processor:.2} s of the processor ({:.2} s of it before the first iterate), {} inverted, smallest {:.2e}, peak {} MB",
        body.n_vertices(),
        summary.status,
        summary.iterations,
        summary.factorizations,
        first.get().unwrap_or_default(),
        solution.quality.inverted,
        solution.quality.smallest,
        peak_megabytes(),
    );
    parts(case, &problem, &solution);
}

/// What the parts of one iteration of a session cost: a handle has been moved a little from a solution.
fn parts(case: &str, problem: &Problem, solution: &Solution) {
    let terms = problem
        .body
        .terms(&problem.energy, problem.barrier, None)
        .expect("an energy of this dimension");
    let mut objective = Objective::of_terms(problem.body.n_vertices(), terms);
    let handles = &problem.stations[0];
    objective.fix(&handles.vertices);
    let x = &solution.x;
    let mut newton = vec![0.0; x.len()];
    let mut follow = vec![0.0; x.len()];
    let assembly = least(|| objective.linearize(x, 0.0));
    let factor = least(|| {
        black_box(objective.newton_direction(&mut newton).is_ok());
    });
    let solve = least(|| {
        follow.fill(0.0);
        for &v in &handles.vertices {
            follow[problem.body.dim() * v as usize] = 1e-3;
        }
        objective
            .follow(&mut follow, &[])
            .expect("a definite matrix");
    });
    let step = least(|| {
        black_box(objective.largest_step(x, &follow));
    });
    let value = least(|| {
        black_box(objective.value(x));
    });
    let (megabytes, gigaflops) = objective
        .work()
        .map_or((0, 0.0), |w| (8 * w.stored / 1_000_000, 1e-9 * w.flops));
    println!(
        "{case} {:?}: factor {} MB, {:.1} Gflop; one iteration {:.1} ms: assembly {assembly:.1}, factor and solve {factor:.1}, following {solve:.1}, \
         largest step {step:.1}, value {value:.1}",
        problem.energy,
        megabytes,
        gigaflops,
        assembly + factor + solve + step + value
    );
}

/// Milliseconds on the wall, least of five.
fn least(mut action: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let clock = Clock::start();
        action();
        1e3 * clock.seconds().wall
    });
    times.fold(f64::INFINITY, f64::min)
}

/// Lets the peak of memory begin anew.
fn forget_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}
