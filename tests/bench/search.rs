//! The search for where to cut, beside the cutters.
//!
//! `cargo bench -p unwrapd-layout --bench search -- [--bound E] FILE.obj…` prints for each file and way: charts, seam length over the root of
//! the area, processor seconds on one thread, and how many faces were mapped and predicted for each face of the file. Ways:
//! `cutters`, without cuts for fill and symmetry; `surface`, the search from pieces or components slit open; `charts`, the search from
//! the charts of the cutters, or from components slit open if these cost less; both with the effort of the program and without a limit.

#[expect(dead_code, reason = "only processor time is wanted")]
mod clock;
#[expect(dead_code, reason = "only reading is wanted")]
#[path = "../support/zoo.rs"]
mod zoo;

use clock::Clock;
use std::path::Path;
use std::sync::Arc;
use unwrapd_layout::charts::{
    Bound, Bounded, MappedChart, Symmetry, Unobserved, charts_under_bound, seam_length,
};
use unwrapd_layout::search::{CutProblem, SearchEffort, Terms, from_charts, from_surface};
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
    let clock = Clock::start();
    let cut = charts_under_bound(&surface, bound, &options, Symmetry::Off, &Unobserved);
    line(file, "cutters", &cut, &clock, SearchEffort::UNBOUNDED);
    let faces = surface.triangles.len();
    let efforts = [
        ("", SearchEffort::for_surface(faces, faces)),
        (", unbounded", SearchEffort::UNBOUNDED),
    ];
    for (limit, effort) in efforts {
        let terms = Terms {
            effort,
            ..Terms::default()
        };
        let clock = Clock::start();
        let (charts, counts) = from_surface(
            &CutProblem::new(&surface, bound, &Unobserved),
            &terms,
            &options,
            Symmetry::Off,
            &Unobserved,
        );
        line(
            file,
            &format!("surface{limit}"),
            &charts,
            &clock,
            counts.effort,
        );
        let (cut, clock) = (cut.clone(), Clock::start());
        let (charts, counts) = from_charts(
            &CutProblem::new(&surface, bound, &Unobserved),
            cut,
            &terms,
            &options,
            &Unobserved,
        );
        line(
            file,
            &format!("charts{limit}"),
            &charts,
            &clock,
            counts.effort,
        );
    }
}

fn line(file: &str, way: &str, charts: &[MappedChart], clock: &Clock, effort: SearchEffort) {
    let area: f64 = charts.iter().map(MappedChart::surface_area).sum();
    let faces: usize = charts.iter().map(|map| map.chart.corners.len()).sum();
    let per_face = |n: usize| n as f64 / faces as f64;
    let mapped = per_face(effort.mapped_faces);
    let predicted = per_face(effort.predicted_faces);
    println!(
        "{file} {way}: {} charts, seam {:.3}, {:.2} s, {mapped:.0} maps and {predicted:.0} predictions per face",
        charts.len(),
        seam_length(charts) / area.sqrt(),
        clock.seconds().processor,
    );
}
