//! Where a map of a chart overlaps itself, and which seam ends that.

use crate::charts::min_cut::min_cut;
use unwrapd_maps::mesh::{CUT, Disk, next};
use unwrapd_maps::plane::{doubled_polygon_area, meeting_point, overlapping_pairs};
use unwrapd_method::numerics::bounds::{bounds_of, touch};
use unwrapd_method::numerics::vec3::distance;
use unwrapd_method::solver::Control;

/// Pairs of triangles whose images overlap, in ascending order and each so, decided exactly; `uv`
/// has no flip.
///
/// Most charts cost a test of their boundary only: a map without flips is injective if the images of the boundary loops are
/// simple and apart and all but one of them turn clockwise. (Then they turn as often as the disk's Euler number says, so no
/// interior vertex is wound around twice, and how often a point is covered, the sum of their windings, is 0 or 1.)
pub fn overlaps(disk: &Disk, uv: &[[f64; 2]]) -> Vec<[u32; 2]> {
    if is_simple(disk, uv) {
        return Vec::new();
    }
    let faces: Vec<u32> = (0..disk.triangles.len() as u32).collect();
    overlaps_among(disk, uv, &faces, |_| true)
}

/// Whether the boundary loops are simple and apart and all but one of them turn clockwise.
fn is_simple(disk: &Disk, uv: &[[f64; 2]]) -> bool {
    let loops = disk.boundary_in(uv);
    let outer = loops
        .iter()
        .filter(|l| doubled_polygon_area(l) > 0.0)
        .count();
    outer == 1 && meeting_point(&loops).is_none()
}

/// The same once some faces have moved, given the pairs before; the others are where they were.
pub fn overlaps_after(
    disk: &Disk,
    uv: &[[f64; 2]],
    before: &[[u32; 2]],
    moved: &[u32],
) -> Vec<[u32; 2]> {
    let corners = |f: u32| disk.triangles[f as usize].map(|v| uv[v as usize]);
    let mut has_moved = vec![false; disk.triangles.len()];
    for &f in moved {
        has_moved[f as usize] = true;
    }
    let places: Vec<[f64; 2]> = moved.iter().flat_map(|&f| corners(f)).collect();
    let region = bounds_of(&places);
    let near: Vec<u32> = (0..disk.triangles.len() as u32)
        .filter(|&f| touch(&bounds_of(&corners(f)), &region))
        .collect();
    let is_new = |pair: &[u32; 2]| pair.iter().any(|&f| has_moved[f as usize]);
    let mut pairs = overlaps_among(disk, uv, &near, is_new);
    pairs.extend(before.iter().filter(|pair| !is_new(pair)));
    pairs.sort_unstable();
    pairs
}

/// The pairs among some faces that are asked for, in ascending order; where faces lie in heaps, a
/// part of them.
fn overlaps_among(
    disk: &Disk,
    uv: &[[f64; 2]],
    faces: &[u32],
    is_asked: impl Fn(&[u32; 2]) -> bool,
) -> Vec<[u32; 2]> {
    let corners: Vec<_> = (faces.iter())
        .map(|&f| disk.triangles[f as usize].map(|v| uv[v as usize]))
        .collect();
    let mut pairs = Vec::new();
    let named = |pair: [u32; 2]| pair.map(|i| faces[i as usize]);
    let is_asked = |pair| is_asked(&named(pair));
    overlapping_pairs(&corners, is_asked, |pair| pairs.push(named(pair)));
    pairs.sort_unstable();
    pairs
}

/// Faces on one side of the seam that parts a fold, given the gluing of a chart, the lengths of its halfedges and the pairs of its
/// faces that overlap.
///
/// A connected set of faces is grown, from the one with most partners, as long as it overlaps nothing of its own; the cheapest
/// seam between it and all its partners is a minimum cut of the dual graph. Any seam between them will do once `control` says so.
pub fn one_side(
    twin: &[u32],
    length: &[f64],
    pairs: &[[u32; 2]],
    control: &dyn Fn() -> Control,
) -> Vec<bool> {
    let partners = Partners::new(twin.len() / 3, pairs);
    let (sources, sinks) = partners.sheet_and_its_partners(twin);
    let capacity = capacities(twin, length);
    min_cut(twin, &capacity, &sources, &sinks, control)
}

/// Lengths as integers: the longest is 2²⁰, none is 0.
pub fn capacities(twin: &[u32], length: &[f64]) -> Vec<u64> {
    let longest = length.iter().fold(f64::MIN_POSITIVE, |l, &x| l.max(x));
    let unit = f64::from(1 << 20) / longest;
    (0..)
        .zip(twin)
        .map(|(h, &t): (usize, _)| match t {
            CUT => 0,
            t => 1 + (length[h.min(t as usize)] * unit) as u64,
        })
        .collect()
}

/// The length of each halfedge.
pub fn lengths(disk: &Disk, positions: &[[f64; 3]]) -> Vec<f64> {
    let vertex = |h: u32| positions[disk.triangles[h as usize / 3][h as usize % 3] as usize];
    (0..3 * disk.triangles.len() as u32)
        .map(|h| distance(vertex(h), vertex(next(h))))
        .collect()
}

/// For each face those it overlaps.
struct Partners {
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Partners {
    fn new(n_faces: usize, pairs: &[[u32; 2]]) -> Self {
        let mut starts = vec![0; n_faces + 1];
        for &face in pairs.as_flattened() {
            starts[face as usize + 1] += 1;
        }
        for face in 0..n_faces {
            starts[face + 1] += starts[face];
        }
        let mut cursor = starts.clone();
        let mut faces = vec![0; 2 * pairs.len()];
        for &[a, b] in pairs {
            for (face, partner) in [(a, b), (b, a)] {
                faces[cursor[face as usize] as usize] = partner;
                cursor[face as usize] += 1;
            }
        }
        Self { starts, faces }
    }

    fn of(&self, face: u32) -> &[u32] {
        let face = face as usize;
        &self.faces[self.starts[face] as usize..self.starts[face + 1] as usize]
    }

    /// A connected set of faces of which no two overlap, and all that they overlap.
    fn sheet_and_its_partners(&self, twin: &[u32]) -> (Vec<u32>, Vec<u32>) {
        let n_faces = self.starts.len() as u32 - 1;
        let first = (0..n_faces).rev().max_by_key(|&f| self.of(f).len());
        let (mut sheet, mut partners) = (Vec::new(), Vec::new());
        let mut is_decided = vec![false; n_faces as usize];
        let mut queue = Vec::from_iter(first);
        let mut done = 0;
        while let Some(&face) = queue.get(done) {
            done += 1;
            if std::mem::replace(&mut is_decided[face as usize], true) {
                continue;
            }
            sheet.push(face);
            for &partner in self.of(face) {
                if !std::mem::replace(&mut is_decided[partner as usize], true) {
                    partners.push(partner);
                }
            }
            let across = (3 * face..3 * face + 3).map(|h| twin[h as usize]);
            let neighbors = across.filter(|&t| t != CUT).map(|t| t / 3);
            queue.extend(neighbors.filter(|&f| !self.of(f).is_empty()));
        }
        (sheet, partners)
    }
}
