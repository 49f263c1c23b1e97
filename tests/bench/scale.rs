//! How the time of `parameterize` grows, and what it is at the small end.
//!
//! `cargo bench --bench scale -- [FILE …]`; without arguments camelhead. Each file is subdivided at the middles of its edges until
//! it has half a million triangles (`LARGEST` in the environment says otherwise); symmetric Dirichlet to the default
//! tolerance. Seconds are wall time, beside them the processor's.

mod clock;
mod meshes;

use std::sync::Arc;

use clock::{Clock, Seconds};
use unwrapd::embed::{Options, parameterize};
use unwrapd::energy::SymmetricDirichlet;
use unwrapd::mesh::Disk;
use unwrapd::solver::{Control, Iterate};

fn main() {
    let mut files: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if files.is_empty() {
        files = meshes::of("disk")
            .into_iter()
            .filter(|file| file.contains("camelhead"))
            .collect();
    }
    let largest =
        std::env::var("LARGEST").map_or(500_000, |value| value.parse().expect("a number"));
    for file in files {
        match meshes::read(&file) {
            Some(surface) => grow(&file, surface.positions, surface.triangles, largest),
            None => println!("{file}: not read"),
        }
    }
}

fn options() -> Options {
    Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    }
}

/// The mesh and its subdivisions, and the exponent of the time between the first and the last.
fn grow(file: &str, mut positions: Vec<[f64; 3]>, mut triangles: Vec<[u32; 3]>, largest: usize) {
    let mut first: Option<(f64, f64)> = None;
    while triangles.len() <= largest {
        let disk = match Disk::new(positions.len(), triangles.clone()) {
            Ok(disk) => disk,
            Err(reason) => return println!("{file}: {reason}"),
        };
        let clock = Clock::start();
        let steps = std::cell::RefCell::new(Vec::new());
        let map = parameterize(&disk, &positions, &options(), &|i: &Iterate| {
            steps.borrow_mut().push((clock.seconds().wall, i.energy));
            Control::Continue
        });
        let Seconds { wall, processor } = clock.seconds();
        let n = triangles.len() as f64;
        let (n_first, processor_first) = *first.get_or_insert((n, processor));
        let steps = steps.into_inner();
        println!(
            "{file}: {n} triangles, {wall:.2} s ({processor:.2} s of the processor, exponent {:.2}); on the finest level {:.2} s, \
             {} steps, {} factorizations, energy from {:.4} % above its last; {:?}; peak {} MB",
            (processor / processor_first).ln() / (n / n_first).ln(),
            wall - steps[0].0,
            map.summary.iterations,
            map.summary.factorizations,
            100.0 * (steps[0].1 / map.summary.energy_last - 1.0),
            map.summary.status,
            clock::peak_megabytes(),
        );
        triangles = meshes::subdivided(&mut positions, &triangles);
    }
}
