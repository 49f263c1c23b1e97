//! The search for where to cut.
//!
//! `cargo bench -p unwrapd-layout --bench search -- [--bound E] FILE.obj…` prints for each file, with and without symmetry: charts, seam
//! length over the root of the area, ln(½ + S + n/10), processor seconds on one thread, and how many faces were mapped and predicted for
//! each face of the file.

#[expect(dead_code, reason = "only processor time is wanted")]
mod clock;
#[expect(dead_code, reason = "only reading is wanted")]
#[path = "../support/zoo.rs"]
mod zoo;

use clock::Clock;
use std::path::Path;
use std::sync::Arc;
use unwrapd_layout::charts::{Bound, Bounded, MappedChart, Symmetry, Unobserved, seam_length};
use unwrapd_layout::search::{CutProblem, SearchEffort, Terms, from_surface};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::{Surface, canonical_order};
use unwrapd_method::energy::SymmetricDirichlet;

fn main() {
    let mut bound = Bound {
        mean: 4.1,
        stretch: None,
        of: Bounded::Surface,
    };
    let mut files = Vec::new();
    let mut arguments = std::env::args().skip(1).filter(|it| it != "--bench");
    while let Some(argument) = arguments.next() {
        if argument == "--bound" {
            bound.mean = arguments
                .next()
                .and_then(|it| it.parse().ok())
                .expect("an energy");
        } else {
            files.push(argument);
        }
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("one thread")
        .install(|| files.iter().for_each(|file| report(file, &bound)));
}

fn report(file: &str, bound: &Bound) {
    let Some(mesh) = zoo::read_mesh(Path::new(file)) else {
        println!("{file}: no OBJ or OFF file");
        return;
    };
    let surface = Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh");
    let surface = surface.reordered(&canonical_order(&surface));
    let options = Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    };
    let faces = surface.triangles.len();
    let terms = Terms {
        effort: SearchEffort::for_surface(faces, faces),
        ..Terms::default()
    };
    for symmetry in [Symmetry::Off, Symmetry::Auto] {
        let clock = Clock::start();
        let problem = CutProblem::new(&surface, bound, &Unobserved);
        let (charts, counts) = from_surface(&problem, &terms, &options, symmetry, &Unobserved);
        let seconds = clock.seconds().processor;
        let area: f64 = charts.iter().map(MappedChart::surface_area).sum();
        let seam = seam_length(&charts) / area.sqrt();
        let n = charts.len();
        println!(
            "{file} {symmetry:?}: {n} charts, seam {seam:.3}, {:.3}, {seconds:.2} s, {:.0} maps and {:.0} predictions per face",
            (0.5 + seam + n as f64 / 10.0).ln(),
            counts.effort.mapped_faces as f64 / faces as f64,
            counts.effort.predicted_faces as f64 / faces as f64,
        );
    }
}
