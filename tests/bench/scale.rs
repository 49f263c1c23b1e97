//! How the time of `parameterize` grows, and what it is at the small end.
//!
//! `cargo bench --bench scale -- [FILE …]`; without arguments camelhead. Each file is subdivided at the middles of its edges until
//! it has half a million triangles (`LARGEST` in the environment says otherwise); symmetric Dirichlet to the default
//! tolerance. Then 20,000 charts of 50 triangles from a work queue. Seconds are wall time, beside them the processor's.

mod meshes;

use std::time::Instant;

use rayon::prelude::*;
use unwrapd::embed::{Options, parameterize};
use unwrapd::energy::EnergyKind;
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
    small_charts();
}

fn options() -> Options {
    Options {
        energy: EnergyKind::SymmetricDirichlet,
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
        let (wall, processor) = (Instant::now(), processor_seconds());
        let steps = std::cell::RefCell::new(Vec::new());
        let map = parameterize(&disk, &positions, &options(), &|i: &Iterate| {
            steps
                .borrow_mut()
                .push((wall.elapsed().as_secs_f64(), i.energy));
            Control::Continue
        });
        let (wall, processor) = (
            wall.elapsed().as_secs_f64(),
            processor_seconds() - processor,
        );
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
            peak_megabytes(),
        );
        triangles = meshes::subdivided(&mut positions, &triangles);
    }
}

/// 20,000 strips of 5 by 5 squares, bent each in another way, on all threads.
fn small_charts() {
    const SIDE: u32 = 5;
    let index = |i: u32, j: u32| i * (SIDE + 1) + j;
    let squares = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j)));
    let triangles: Vec<[u32; 3]> = squares
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [
                index(i, j),
                index(i + 1, j),
                index(i + 1, j + 1),
                index(i, j + 1),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let n_vertices = ((SIDE + 1) * (SIDE + 1)) as usize;
    let disk = Disk::new(n_vertices, triangles).expect("a disk");
    let bent = |k: usize| -> Vec<[f64; 3]> {
        let bend = 0.5 + (k % 97) as f64 / 97.0;
        let position = |v: usize| {
            let (x, y) = ((v / 6) as f64, (v % 6) as f64);
            [x, y, bend * (x * 0.7 + y * 0.4 * bend).sin()]
        };
        (0..n_vertices).map(position).collect()
    };
    let (wall, processor) = (Instant::now(), processor_seconds());
    let steps: usize = (0..20_000_usize)
        .into_par_iter()
        .map(|k| {
            parameterize(&disk, &bent(k), &options(), &|_: &Iterate| {
                Control::Continue
            })
            .summary
            .iterations
        })
        .sum();
    println!(
        "20,000 charts of {} triangles: {:.2} s ({:.2} s of the processor), {:.1} steps each",
        disk.triangles.len(),
        wall.elapsed().as_secs_f64(),
        processor_seconds() - processor,
        steps as f64 / 20_000.0
    );
}

/// User and system time of this process.
fn processor_seconds() -> f64 {
    const TICKS_PER_SECOND: f64 = 100.0;
    let line = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = line
        .rsplit(')')
        .next()
        .unwrap_or_default()
        .split_whitespace();
    let ticks = fields
        .skip(11)
        .take(2)
        .filter_map(|field| field.parse::<f64>().ok());
    ticks.sum::<f64>() / TICKS_PER_SECOND
}

fn peak_megabytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) / 1024
}
