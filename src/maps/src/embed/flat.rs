//! The map of a disk that lies in a plane.

use super::positive::is_positive;
use crate::mesh::Disk;
use crate::plane::keep_apart;
use unwrapd_method::numerics::vec3::{area_vector, cross, dot, norm, sub};

/// Largest distance of vertices from the plane, as a share of the disk's extent: the rounding of coordinates in `f32`.
const FLAT: f64 = 1e-6;

/// Least distance of the boundary from itself, as a share of the disk's extent: a few times the rounding of coordinates
/// in `f32`. A disk that comes nearer, such as a slit one, must be opened: rounding would close it.
const APART: f64 = 2e-7;

/// Returns the disk as it lies, in its own unit, seen from the side from which its triangles are counter-clockwise;
/// `None` if it is not flat, a triangle is flipped or empty there, or the boundary touches itself.
///
/// No other map has less distortion, and long arms, where Tutte's map is far from any optimum, cost nothing.
pub(super) fn flat_map(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let origin = *positions.first()?;
    let reach = (positions.iter())
        .flat_map(|&p| sub(p, origin).map(f64::abs))
        .fold(0.0, f64::max);
    if !reach.is_normal() {
        return None;
    }
    let relative: Vec<[f64; 3]> = (positions.iter())
        .map(|&p| sub(p, origin).map(|x| x / reach))
        .collect();
    let normal = normal(disk, &relative)?;
    if relative.iter().any(|&p| dot(p, normal).abs() > FLAT) {
        return None;
    }
    let [u, v] = axes(normal);
    let uv: Vec<[f64; 2]> = relative.iter().map(|&p| [dot(p, u), dot(p, v)]).collect();
    if !is_positive(&disk.triangles, &uv) || !keep_apart(&disk.boundary_in(&uv), APART) {
        return None;
    }
    Some(uv.into_iter().map(|p| p.map(|x| reach * x)).collect())
}

/// Returns the unit normal of most of the area.
fn normal(disk: &Disk, positions: &[[f64; 3]]) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    for triangle in &disk.triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let area = area_vector(a, b, c);
        (0..3).for_each(|k| sum[k] += area[k]);
    }
    let length = norm(sum);
    length.is_normal().then(|| sum.map(|x| x / length))
}

/// Returns two unit vectors that form a right-handed frame with a third.
fn axes(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let least = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
    let mut axis = [0.0; 3];
    axis[least.unwrap_or(0)] = 1.0;
    let u = cross(axis, normal);
    let length = norm(u);
    let u = u.map(|x| x / length);
    [u, cross(normal, u)]
}
