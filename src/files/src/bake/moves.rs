//! Islands that have moved by whole texels.

use super::Corners;
use super::coverage::{Coverage, Triangle, doubled_area};
use super::plane::{Frames, Plane, Sampled};
use std::collections::HashMap;
use unwrapd_maps::mesh::UnionFind;

/// Greatest distance of a corner from a move by whole texels, in texels. Layouts round UVs to a grid of 2⁻²³, which is off
/// by up to 1/2048 of a texel at 8192 texels; this admits four times as much, since the old UVs are rounded, too.
const NEAR: f64 = 1.0 / 512.0;
/// Greatest change of a tangent that counts as none, per coordinate: a quarter of the step between two codes of 8 bits.
const SAME_TANGENT: f32 = 0.5 / 255.0;

/// A move from the new texture to the old one, by quarter turns, a flip and whole texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WholeMove {
    /// Linear part: a permutation of the axes with signs, row by row.
    axes: [[i64; 2]; 2],
    /// Shift in texels.
    shift: [i64; 2],
    /// `true` if directions relative to tangents need no conversion.
    pub keeps_directions: bool,
}

impl WholeMove {
    /// Returns the move by whole texels that is nearest to the affine map from one triangle to another; `None` if a
    /// corner is not near its place.
    fn between(target: &Corners, source: &Corners) -> Option<Self> {
        let [[a, b], [c, d]] = Triangle::new(*target)?.jacobian(source);
        let sign = |x: f64| if x < 0.0 { -1 } else { 1 };
        let axes = if a.abs() + d.abs() >= b.abs() + c.abs() {
            [[sign(a), 0], [0, sign(d)]]
        } else {
            [[0, sign(b)], [sign(c), 0]]
        };
        let turned = Self {
            axes,
            shift: [0; 2],
            keeps_directions: true,
        };
        let first = turned.place(target[0]);
        let moved = Self {
            shift: [0, 1].map(|k| (source[0][k] - first[k]).round() as i64),
            ..turned
        };
        moved.fits(target, source).then_some(moved)
    }

    fn fits(&self, target: &Corners, source: &Corners) -> bool {
        let is_near = |(target, source): (&[f64; 2], &[f64; 2])| {
            let place = self.place(*target);
            (0..2).all(|k| (place[k] - source[k]).abs() <= NEAR)
        };
        target.iter().zip(source).all(is_near)
    }

    fn place(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|row| {
            let [x, y] = self.axes[row].map(|axis| axis as f64);
            x * at[0] + y * at[1] + self.shift[row] as f64
        })
    }

    /// Returns the texel of the old texture for one of the new texture.
    pub fn source(&self, [x, y]: [usize; 2]) -> [i64; 2] {
        let place = self.place([x as f64 + 0.5, y as f64 + 0.5]);
        place.map(|x| x.floor() as i64)
    }
}

/// Returns the move of each face whose whole island has moved by whole texels. An island is a set of faces that are
/// connected by corners at the same places in both textures.
pub(super) fn whole_moves(plane: &Plane, coverage: &Coverage) -> Vec<Option<WholeMove>> {
    // Find the move of each face; an island's is that of its largest face, which tells turns apart best.
    let sampled = |face: usize| plane.faces[face].as_ref();
    let corners = |face: usize| coverage.corners(face as u32);
    let n_faces = plane.faces.len();
    let of_faces: Vec<Option<WholeMove>> = (0..n_faces)
        .map(|face| WholeMove::between(corners(face), &sampled(face)?.corners))
        .collect();
    if of_faces.iter().all(Option::is_none) {
        return of_faces;
    }
    let islands = islands(plane, coverage);
    let mut largest: HashMap<u32, (f64, usize)> = HashMap::new();
    for face in (0..n_faces).filter(|&face| sampled(face).is_some()) {
        let entry = largest.entry(islands[face]).or_insert((-1.0, face));
        let area = doubled_area(corners(face));
        if area > entry.0 {
            *entry = (area, face);
        }
    }
    // Keep the moves that all faces of an island follow.
    let mut moves: HashMap<u32, Option<WholeMove>> = largest
        .into_iter()
        .map(|(island, (_, face))| (island, of_faces[face]))
        .collect();
    for face in 0..n_faces {
        let Some((sampled, moved)) = sampled(face).zip(moves.get_mut(&islands[face])) else {
            continue;
        };
        *moved = moved.filter(|moved| moved.fits(corners(face), &sampled.corners));
        if let (Some(moved), Some(frames)) = (moved, &plane.frames) {
            moved.keeps_directions &= keeps_tangents(frames, face);
        }
    }
    let of_island = |face: usize| moves.get(&islands[face]).copied().flatten();
    (0..n_faces)
        .map(|face| sampled(face).and_then(|_| of_island(face)))
        .collect()
}

/// Returns the number of each face's island.
fn islands(plane: &Plane, coverage: &Coverage) -> Vec<u32> {
    let mut sets = UnionFind::new(plane.faces.len());
    let mut first: HashMap<(u32, [u64; 4]), u32> = HashMap::new();
    for (face, sampled) in (0u32..).zip(&plane.faces) {
        let Some(Sampled { texture, corners }) = sampled else {
            continue;
        };
        for (source, target) in corners.iter().zip(coverage.corners(face)) {
            let place = [source[0], source[1], target[0], target[1]].map(f64::to_bits);
            sets.unite(face, *first.entry((*texture, place)).or_insert(face));
        }
    }
    sets.labels().0
}

/// Returns whether the tangents of a face are those of the old map.
fn keeps_tangents(frames: &Frames, face: usize) -> bool {
    let (from, to) = (&frames.from[face], &frames.to[face]);
    let pairs = from.as_flattened().iter().zip(to.as_flattened());
    pairs
        .map(|(a, b)| (a - b).abs())
        .all(|change| change <= SAME_TANGENT)
}
