//! What an iteration costs with an energy by formula, beside the same energy by name: asked at most three times as much.
//!
//! `cargo bench --bench formulas`. A sheet of 20,000 triangles and the armadillo's 55,000 tetrahedra are pulled at their ends. Of
//! each run the processor's milliseconds per iteration are printed, and of the Newton step alone, least of five, those of
//! gradient and Hessian and those of one value.

#[expect(dead_code, reason = "only the processor's time is looked at")]
mod clock;
#[expect(
    dead_code,
    reason = "solids are not subdivided, nor read from a folder"
)]
mod meshes;

use std::hint::black_box;

use clock::Clock;
use unwrapd::deform::{Body, Handle, Model, Problem};
use unwrapd::io::gmsh;
use unwrapd::mesh::PlanarMesh;
use unwrapd::solver::{Control, Iterate, Objective, Settings};

/// Name, and formula in the plane and in space.
const ENERGIES: [[&str; 3]; 3] = [
    [
        "arap",
        "((s1 - 1)^2 + (s2 - 1)^2)/2",
        "((s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)^2)/2",
    ],
    [
        "symmetric-dirichlet",
        "s1^2 + s2^2 + s1^-2 + s2^-2",
        "s1^2 + s2^2 + s3^2 + s1^-2 + s2^-2 + s3^-2",
    ],
    [
        "mips",
        "(s1/s2 + s2/s1)/2",
        "(s1^2 + s2^2 + s3^2)/(3*(s1*s2*s3)^(2/3))",
    ],
];

/// Has no name.
const HENCKY: [&str; 2] = ["log(s1)^2 + log(s2)^2", "log(s1)^2 + log(s2)^2 + log(s3)^2"];

fn main() {
    for (case, body, dim) in [("sheet", sheet(100), 2), ("armadillo", armadillo(), 3)] {
        for texts in ENERGIES {
            let named = Cost::of(&body, texts[0]);
            let typed = Cost::of(&body, texts[dim - 1]);
            named.print(case, texts[0]);
            typed.print(case, texts[dim - 1]);
            println!(
                "{case} {}: an iteration asked <= 3, got {:.2} times as much; derivatives {:.2}, value {:.2}",
                texts[0],
                typed.iteration / named.iteration,
                typed.derivatives / named.derivatives,
                typed.value / named.value,
            );
        }
        Cost::of(&body, HENCKY[dim - 2]).print(case, HENCKY[dim - 2]);
    }
}

/// Milliseconds.
struct Cost {
    iterations: usize,
    iteration: f64,
    derivatives: f64,
    value: f64,
}

impl Cost {
    fn of(body: &Body, energy: &str) -> Self {
        let model = Model {
            energy: energy.parse().expect("an energy"),
            ..Model::default()
        };
        let problem = Problem::new(body.clone(), &ends(body), &model).expect("a problem");
        let clock = Clock::start();
        let solution = problem
            .solve(&Settings::follow(), &|_: &Iterate| Control::Continue)
            .expect("a solution");
        let seconds = clock.seconds().processor;
        let terms = (problem.body)
            .terms(&problem.energy, problem.barrier, None)
            .expect("an energy of this dimension");
        let mut objective = Objective::of_terms(body.n_vertices(), terms);
        let iterations = solution.summary.iterations;
        Self {
            iterations,
            iteration: 1e3 * seconds / iterations as f64,
            derivatives: least(|| objective.linearize(&solution.x, 0.0)),
            value: least(|| {
                black_box(objective.value(&solution.x));
            }),
        }
    }

    fn print(&self, case: &str, energy: &str) {
        println!(
            "{case} {energy}: {} iterations of {:.2} ms; derivatives {:.2} ms, value {:.2} ms",
            self.iterations, self.iteration, self.derivatives, self.value
        );
    }
}

/// Milliseconds of the processor, least of five.
fn least(mut action: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let clock = Clock::start();
        action();
        1e3 * clock.seconds().processor
    });
    times.fold(f64::INFINITY, f64::min)
}

/// Discs at the two ends of the first axis; one is shifted across it by a tenth of the length.
fn ends(body: &Body) -> [Handle; 2] {
    let points = || body.rest.chunks_exact(body.dim());
    let first = points().min_by(|p, q| p[0].total_cmp(&q[0]));
    let last = points().max_by(|p, q| p[0].total_cmp(&q[0]));
    let (first, last) = (first.expect("a vertex"), last.expect("a vertex"));
    let length = last[0] - first[0];
    [(first, 0.0), (last, 0.1)].map(|(center, shift)| {
        let mut to = center.to_vec();
        to[1] += shift * length;
        Handle::Disc {
            center: center.to_vec(),
            radius: 0.1 * length,
            to,
            turn: 0.0,
            axis: None,
            weight: None,
        }
    })
}

fn armadillo() -> Body {
    let bytes = std::fs::read(meshes::path("tet/Armadillo13K.msh")).expect("test data");
    let elements = gmsh::read(&bytes).expect("a mesh");
    Body::from(&elements.into_tet_mesh().expect("tetrahedra"))
}

/// `n` by `n` unit squares, two triangles each.
fn sheet(n: u32) -> Body {
    let side = n + 1;
    let vertices = (0..side * side).map(|v| [f64::from(v % side), f64::from(v / side)]);
    let squares = (0..n * n).map(|k| k / n * side + k % n);
    let triangles = squares.flat_map(|a| [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]);
    let mesh = PlanarMesh::new(vertices.collect(), triangles.collect());
    Body::from(&mesh.expect("a sheet"))
}
