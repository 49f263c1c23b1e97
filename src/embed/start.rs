//! A map without flips to start from.

use super::closed::ClosedDisk;
use super::tutte::{Boundary, tutte_embedding};
use crate::mesh::Disk;
use crate::numerics::predicates::orient2d_sign;

/// A locally injective map of the disk: counter-clockwise and positive in every triangle, exactly.
///
/// Holes are closed first, so it is injective where it is Tutte's. Its size and distortion are arbitrary.
pub fn start(disk: &Disk, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let closed = ClosedDisk::new(disk, positions);
    let mut uv = tutte(&closed).unwrap_or_default();
    uv.truncate(disk.n_vertices);
    uv
}

/// Tutte's map, if floating point left every triangle positive.
///
/// Equal angles are tried second: they spare what short boundary edges squeeze.
pub(super) fn tutte(closed: &ClosedDisk) -> Option<Vec<[f64; 2]>> {
    [Boundary::ArcLength, Boundary::EqualAngles]
        .into_iter()
        .map(|boundary| tutte_embedding(closed, boundary))
        .find(|uv| first_bad_triangle(&closed.triangles, uv).is_none())
}

/// The first triangle that is not exactly positive.
pub(super) fn first_bad_triangle(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> Option<usize> {
    triangles.iter().position(|t| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        orient2d_sign(a, b, c) <= 0
    })
}
