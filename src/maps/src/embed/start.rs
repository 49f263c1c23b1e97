//! A start without flips.

use super::closed::ClosedDisk;
use super::hierarchy::coarse_to_fine;
use super::rest::{RestShapes, rest_shapes};
use super::tutte::{Boundary, tutte, tutte_embedding};
use crate::mesh::Disk;

/// Returns a locally injective map of the disk: counter-clockwise and positive in every triangle, exactly.
///
/// Returns Tutte's map if floating point allows, otherwise that of the hierarchy. Holes are closed first. Size and
/// distortion are arbitrary. If both fail, as for a few disks with hundreds of empty triangles, returns Tutte's map as
/// floating point left it: a caller that needs a valid map checks it again ([`is_positive`](super::is_positive)) and
/// cuts the disk.
pub fn start(disk: &Disk, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
    tutte_start(disk, positions)
        .or_else(|| hierarchical_start(disk, positions))
        .unwrap_or_else(|| {
            let closed = ClosedDisk::new(disk, positions);
            let mut uv = tutte_embedding(&closed, Boundary::ArcLength);
            uv.truncate(disk.n_vertices);
            uv
        })
}

/// Returns Tutte's map, if floating point left every triangle positive, including those that close the holes.
pub fn tutte_start(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let mut uv = tutte(&ClosedDisk::new(disk, positions))?;
    uv.truncate(disk.n_vertices);
    Some(uv)
}

/// Returns a map found coarse to fine. It takes longer than Tutte's but ends near an optimum, in the unit of
/// [`rest_shapes`], and hardly ever fails.
pub fn hierarchical_start(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    hierarchical_start_at(disk, positions, &rest_shapes(positions, &disk.triangles))
}

/// Like [`hierarchical_start`], with known rest shapes.
pub(super) fn hierarchical_start_at(
    disk: &Disk,
    positions: &[[f64; 3]],
    rest: &RestShapes,
) -> Option<Vec<[f64; 2]>> {
    let closed = ClosedDisk::new(disk, positions);
    let relative: Vec<[f64; 3]> = (closed.positions.iter())
        .map(|p| p.map(|x| x / rest.scale))
        .collect();
    let mut uv = coarse_to_fine(&closed, &relative, rest.least)?;
    uv.truncate(disk.n_vertices);
    Some(uv)
}
