//! Islands shifted to whole texels.
//!
//! Texels of a texture can be copied only where an island moves by whole texels. Packing puts islands anywhere. One that
//! keeps its size and turns by quarters is then shifted by up to half a texel along each axis, for which it is packed with
//! [`ROOM_TEXELS`] more.

use super::repeated::GridCorners;
use std::collections::HashMap;
use unwrapd_layout::atlas::GRID_BITS;
use unwrapd_maps::mesh::{CornerUvs, UnionFind};

/// Distance by which two islands may come nearer to each other, in texels: half a texel along both axes, each.
pub const ROOM_TEXELS: f64 = std::f64::consts::SQRT_2;
/// Greatest distance of a corner from a move by quarter turns, in texels: what resampling takes for none.
const NEAR: f64 = 1.0 / 512.0;

/// Shifts the islands of an atlas that keep their size on a texture of `side` texels, and are turned by quarters, by whole
/// texels from where `uvs`, v up, had them. Stacked islands are shifted as one.
pub fn shift_to_whole_texels(grid: &mut [GridCorners], uvs: &[CornerUvs], side: u32) {
    let texel = f64::from(1 << GRID_BITS) / f64::from(side);
    let mut islands: HashMap<u32, Vec<usize>> = HashMap::new();
    for (face, island) in islands_of(grid).into_iter().enumerate() {
        islands.entry(island).or_default().push(face);
    }
    for faces in islands.values() {
        let moves = faces.iter().map(|&face| {
            Some(IslandMove {
                from: uvs.get(face)?.map(|uv| uv.map(|x| x * f64::from(side))),
                to: grid[face].map(|p| p.map(|x| f64::from(x) / texel)),
            })
        });
        let moves: Option<Vec<IslandMove>> = moves.collect();
        if let Some(part) = moves.and_then(|moves| part_of_texel(&moves)) {
            let back = part.map(|x| (x * texel).round() as i32);
            for face in faces {
                grid[*face] = grid[*face].map(|[u, v]| [u - back[0], v - back[1]]);
            }
        }
    }
}

/// Returns the island of each face: faces are connected by places of corners.
fn islands_of(grid: &[GridCorners]) -> Vec<u32> {
    let mut sets = UnionFind::new(grid.len());
    let mut first: HashMap<[i32; 2], u32> = HashMap::new();
    for (face, corners) in (0..).zip(grid) {
        for corner in corners {
            sets.unite(face, *first.entry(*corner).or_insert(face));
        }
    }
    sets.labels().0
}

/// Corners of a face before and after packing, in texels.
struct IslandMove {
    from: [[f64; 2]; 3],
    to: [[f64; 2]; 3],
}

/// Returns the part of a texel by which an island is off a move by quarter turns, flips and whole texels; `None` if it moves
/// otherwise.
fn part_of_texel(faces: &[IslandMove]) -> Option<[f64; 2]> {
    let size = |face: &IslandMove| determinant(edges(&face.to)).abs();
    let largest = faces.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let axes = nearest_axes(largest)?;
    let turned = |p: [f64; 2]| axes.map(|[x, y]| x * p[0] + y * p[1]);
    let first = turned(largest.from[0]);
    let shift = [0, 1].map(|k| largest.to[0][k] - first[k]);
    let is_near = |(from, to): (&[f64; 2], &[f64; 2])| {
        let place = turned(*from);
        (0..2).all(|k| (place[k] + shift[k] - to[k]).abs() <= NEAR)
    };
    let fits = |face: &IslandMove| face.from.iter().zip(&face.to).all(is_near);
    faces.iter().all(fits).then(|| shift.map(|x| x - x.round()))
}

/// Returns the permutation of the axes with signs that is nearest to the linear part of a face's move.
fn nearest_axes(face: &IslandMove) -> Option<[[f64; 2]; 2]> {
    let (from, to) = (edges(&face.from), edges(&face.to));
    let area = determinant(from);
    if area == 0.0 {
        return None;
    }
    // The image of an axis is a mean of the images of the edges.
    let [e, f] = from;
    let image = |x: [f64; 2], k: usize| {
        (determinant([x, f]) * to[0][k] + determinant([e, x]) * to[1][k]) / area
    };
    let [[a, b], [c, d]] = [0, 1].map(|k| [image([1.0, 0.0], k), image([0.0, 1.0], k)]);
    Some(if a.abs() + d.abs() >= b.abs() + c.abs() {
        [[a.signum(), 0.0], [0.0, d.signum()]]
    } else {
        [[0.0, b.signum()], [c.signum(), 0.0]]
    })
}

fn edges([a, b, c]: &[[f64; 2]; 3]) -> [[f64; 2]; 2] {
    [b, c].map(|p| [p[0] - a[0], p[1] - a[1]])
}

fn determinant([e, f]: [[f64; 2]; 2]) -> f64 {
    e[0] * f[1] - e[1] * f[0]
}
