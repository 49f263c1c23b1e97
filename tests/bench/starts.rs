//! Valid starts for disks that are hard on floating point: closed surfaces without one of their triangles.
//!
//! `cargo bench --bench starts -- [FILE …]`; without arguments every mesh of `../shared/data/closed`. Of each closed surface of
//! genus 0, and of its midpoint subdivisions up to 200,000 triangles, five disks are made, each without another triangle:
//! the rest of the surface is behind a boundary of three vertices. Tells, for each, whether Tutte's map held, whether a
//! valid map was found, and flips after optimization; the last line counts.

mod meshes;

use std::time::Instant;

use unwrapd::embed::{Options, is_positive, parameterize, tutte_start};
use unwrapd::energy::EnergyKind;
use unwrapd::mesh::Disk;
use unwrapd::solver::{Control, Iterate};

/// Triangles of a disk at most.
const LARGEST: usize = 200_000;

/// Disks per surface.
const DISKS: usize = 5;

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
    }
    let mut count = Count::default();
    for file in files {
        let Some(surface) = meshes::read(&file) else {
            continue;
        };
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
        let clock = Instant::now();
        let tutte = tutte_start(&disk, positions).is_some();
        let options = Options {
            energy: EnergyKind::SymmetricDirichlet,
            ..Options::default()
        };
        let map = parameterize(&disk, positions, &options, &|_: &Iterate| Control::Continue);
        let valid = is_positive(&disk.triangles, &map.uv);
        count.disks += 1;
        count.tutte += usize::from(tutte);
        count.valid += usize::from(valid);
        println!(
            "{file}, {} triangles, without number {}: Tutte {}, result {}, {:?}, {} factorizations, {:.2} s",
            disk.triangles.len(),
            k * triangles.len() / DISKS,
            if tutte { "valid" } else { "flipped" },
            if valid { "valid" } else { "FLIPPED" },
            map.summary.status,
            map.summary.factorizations,
            clock.elapsed().as_secs_f64()
        );
    }
    true
}
