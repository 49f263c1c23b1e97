//! Valid starts for disks that are hard on floating point: closed surfaces without one of their triangles.
//!
//! `cargo bench --bench starts -- [FILE …]`; without arguments every mesh of `../shared/data/closed`, and the hard ones of
//! `../shared/data/disk` as they are. Of each closed surface of genus 0, and of its midpoint subdivisions up to 200,000 triangles,
//! seven disks are made, each without another triangle: the rest of the surface is behind a boundary of three vertices. Tells,
//! for each, whether Tutte's map held, whether a valid map was found, and flips after optimization; the last line counts.

mod meshes;

use std::sync::Arc;

use std::time::Instant;

use unwrapd::charts::{Cut, charts};
use unwrapd::embed::{Options, is_positive, parameterize, tutte_start};
use unwrapd::energy::SymmetricDirichlet;
use unwrapd::mesh::{Disk, Surface};
use unwrapd::solver::{Control, Iterate};

/// Disks that are hard as they are: long corridors, triangles without area, long cuts.
const HARD: [&str; 3] = ["maze", "zero_area_49k", "cow_cut"];

/// Triangles of a disk at most.
const LARGEST: usize = 200_000;

/// Disks per surface.
const DISKS: usize = 7;

/// What was counted.
#[derive(Default)]
struct Count {
    disks: usize,
    tutte: usize,
    valid: usize,
}

fn main() {
    let mut files: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if files.is_empty() {
        files = meshes::of("closed");
        let is_hard = |file: &String| HARD.iter().any(|name| file.contains(name));
        files.extend(meshes::of("disk").into_iter().filter(is_hard));
    }
    let mut count = Count::default();
    for file in files {
        let Some(surface) = meshes::read(&file) else {
            continue;
        };
        if file.contains("/disk/") {
            count_components(&file, &surface, &mut count);
            continue;
        }
        let (mut positions, mut triangles) = (surface.positions, surface.triangles);
        while triangles.len() < LARGEST {
            if !count_disks(&file, &positions, &triangles, &mut count) {
                break;
            }
            triangles = meshes::subdivided(&mut positions, &triangles);
        }
    }
    let Count {
        disks,
        tutte,
        valid,
    } = count;
    println!("{disks} disks: Tutte's map valid in floating point {tutte}, valid result {valid}");
}

/// False if the surface is not closed, of genus 0 and in one piece: then what is left of it is no disk.
fn count_disks(
    file: &str,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    count: &mut Count,
) -> bool {
    for k in 0..DISKS {
        let mut rest = triangles.to_vec();
        rest.remove(k * triangles.len() / DISKS);
        let Ok(disk) = Disk::new(positions.len(), rest) else {
            return false;
        };
        if disk.loops.len() != 1 || disk.loops[0].len() != 3 {
            return false;
        }
        let missing = k * triangles.len() / DISKS;
        count_disk(
            &format!("{file} without triangle {missing}"),
            &disk,
            positions,
            count,
        );
    }
    true
}

/// The components of a surface, opened to disks.
fn count_components(file: &str, surface: &Surface, count: &mut Count) {
    for chart in charts(surface, Cut::Disk) {
        count_disk(file, &chart.disk, &chart.positions, count);
    }
}

fn count_disk(name: &str, disk: &Disk, positions: &[[f64; 3]], count: &mut Count) {
    let clock = Instant::now();
    let tutte = tutte_start(disk, positions).is_some();
    let options = Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    };
    let map = parameterize(disk, positions, &options, &|_: &Iterate| Control::Continue);
    let valid = is_positive(&disk.triangles, &map.uv);
    count.disks += 1;
    count.tutte += usize::from(tutte);
    count.valid += usize::from(valid);
    println!(
        "{name}, {} triangles: Tutte {}, result {}, {:?}, {} factorizations, {:.2} s",
        disk.triangles.len(),
        if tutte { "valid" } else { "flipped" },
        if valid { "valid" } else { "FLIPPED" },
        map.summary.status,
        map.summary.factorizations,
        clock.elapsed().as_secs_f64()
    );
}
