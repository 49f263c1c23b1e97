//! The map of a developable disk.

use super::positive::is_positive;
use crate::mesh::{CUT, Disk, next, origin};
use crate::plane::keep_apart;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use unwrapd_method::numerics::vec3::{area_vector, distance, dot, norm, sub};

/// Largest change of lengths, as a share of the disk's extent: the rounding of coordinates in `f32` along a path of a
/// hundred triangles.
const SAME: f64 = 1e-5;

/// Least distance of the boundary from itself, as a share of the disk's extent: nearer parts could touch once
/// coordinates are rounded to `f32`.
const APART: f64 = 1e-6;

/// Unrolls the disk into the plane, in its own unit; returns `None` if that changes the length of an edge, or the
/// boundary meets itself.
///
/// Triangles are laid down one after the other, each next to one that lies already, across long edges first. A
/// cylinder, a cone or a bent sheet comes out without distortion. O(n log n).
pub(super) fn unfolded_map(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let uv = laid_down(disk, positions)?;
    let at = |v: u32| positions[v as usize];
    let longest = (disk.triangles.iter())
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| (a, b, distance(at(a), at(b))));
    let [low, high] = unwrapd_method::numerics::bounds::bounds_of(&uv);
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let is_kept = |(a, b, length): (u32, u32, f64)| {
        let [p, q] = [a, b].map(|v| uv[v as usize]);
        ((q[0] - p[0]).hypot(q[1] - p[1]) - length).abs() <= SAME * extent
    };
    let mut edges = longest;
    let is_isometric = edges.all(is_kept);
    let is_map = is_isometric
        && is_positive(&disk.triangles, &uv)
        && keep_apart(&disk.boundary_in(&uv), APART);
    is_map.then_some(uv)
}

/// An edge across which the next triangle may be laid, the longest first.
#[derive(PartialEq)]
struct Crossing {
    length: f64,
    halfedge: u32,
}

/// Returns the places of all vertices; a vertex with several keeps the one where it was laid first.
fn laid_down(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let twin = disk.twins();
    let mut uv: Vec<Option<[f64; 2]>> = vec![None; disk.n_vertices];
    let mut is_laid = vec![false; disk.triangles.len()];
    let mut open = BinaryHeap::new();
    // Lay the longest edge along the first axis.
    let longest = (0..3 * disk.triangles.len() as u32)
        .map(|h| (length(disk, positions, h), h))
        .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let (length_of_first, first) = longest?;
    uv[origin(&disk.triangles, first) as usize] = Some([0.0, 0.0]);
    uv[origin(&disk.triangles, next(first)) as usize] = Some([length_of_first, 0.0]);
    let mut halfedge = first;
    // Lay one triangle after another, across the longest open edge first.
    loop {
        if !std::mem::replace(&mut is_laid[halfedge as usize / 3], true) {
            lay(disk, positions, halfedge, &mut uv)?;
            for h in [next(halfedge), next(next(halfedge)), halfedge] {
                let t = twin[h as usize];
                if t != CUT && !is_laid[t as usize / 3] {
                    open.push(Crossing {
                        length: length(disk, positions, t),
                        halfedge: t,
                    });
                }
            }
        }
        match open.pop() {
            Some(crossing) => halfedge = crossing.halfedge,
            None => break,
        }
    }
    uv.into_iter().collect()
}

/// Lays the last vertex of a triangle whose edge lies already.
fn lay(
    disk: &Disk,
    positions: &[[f64; 3]],
    halfedge: u32,
    uv: &mut [Option<[f64; 2]>],
) -> Option<()> {
    let corners = [halfedge, next(halfedge), next(next(halfedge))];
    let [a, b, c] = corners.map(|h| origin(&disk.triangles, h) as usize);
    if uv[c].is_some() {
        return Some(());
    }
    let (p, q) = (uv[a]?, uv[b]?);
    let (along, to) = (
        sub(positions[b], positions[a]),
        sub(positions[c], positions[a]),
    );
    let length = norm(along);
    let x = dot(along, to) / length;
    let y = 2.0 * norm(area_vector(positions[a], positions[b], positions[c])) / length;
    let e = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
    let place = [p[0] + x * e[0] - y * e[1], p[1] + x * e[1] + y * e[0]];
    uv[c] = place.iter().all(|x| x.is_finite()).then_some(place);
    uv[c].map(|_| ())
}

fn length(disk: &Disk, positions: &[[f64; 3]], h: u32) -> f64 {
    let [a, b] = [h, next(h)].map(|h| positions[origin(&disk.triangles, h) as usize]);
    distance(a, b)
}

impl Eq for Crossing {}

impl Ord for Crossing {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.length.total_cmp(&other.length)).then_with(|| other.halfedge.cmp(&self.halfedge))
    }
}

impl PartialOrd for Crossing {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
