//! Limbs that change places.

use std::path::{Path, PathBuf};

use unwrapd::deform::{Problem, ProblemFile};
use unwrapd::io::ElementFormat;
use unwrapd::solver::{Settings, Status};

use crate::clock::Clock;
use crate::go_on;
use crate::outcome::{Outcome, conclude};

/// Solves the reference problems.
pub fn woody() {
    let files = std::fs::read_dir(reference()).expect("the reference set");
    let mut names: Vec<String> = files
        .map(|file| {
            file.expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| name.contains("_swap") && name.ends_with("_spline.json"))
        .collect();
    names.sort();
    let mut all = Vec::new();
    for name in &names {
        let problem = read(name);
        let clock = Clock::start();
        let solution = problem
            .solve(&Settings::follow(), &go_on)
            .expect("a problem");
        let summary = solution.summary;
        let seconds = clock.seconds().processor;
        all.push(Outcome {
            handles: 1,
            reached: usize::from(summary.status == Status::Converged),
            seconds,
        });
        println!(
            "{name}: {:?}, {} iterations, {} factorizations, {seconds:.2} s, energy {:.6e}, residual {:.1e}, {} inverted",
            summary.status,
            summary.iterations,
            summary.factorizations,
            solution.quality.energy + solution.quality.barrier,
            solution.quality.residual,
            solution.quality.inverted
        );
    }
    conclude("woody", &all);
}

fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference/problems")
}

fn read(name: &str) -> Problem {
    let folder = reference();
    let json = std::fs::read(folder.join(name)).expect("a problem");
    let file = ProblemFile::parse(&json).expect("a problem");
    let format = ElementFormat::of_name(&file.mesh).expect("a known format");
    let bytes = std::fs::read(folder.join(&file.mesh)).expect("a mesh");
    let mesh = format.read(&bytes).expect("a mesh");
    file.with(mesh, None).expect("a sound problem")
}
