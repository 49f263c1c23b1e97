//! Coarsest rounding of UVs that keeps every orientation.

use super::NAMED;
use super::boundary::{BoundaryEdge, ChartBoundary};
use super::box_tree::BoxVisit;
use super::fixed::{Fixed, UNIT_BITS, cross, difference, dot, fixed, taxicab};
use super::topology::UvTopology;
use crate::mesh::CornerUvs;
use serde::Serialize;

/// Coordinates from here on are not judged. Below, 2²⁰ · 2⁴⁰ units give sums of products up to 2¹²³, within `i128`.
const LIMIT: f64 = (1 << 20) as f64;

/// Bits to which files are quantized, the coarsest first: 12 is the default of gltfpack and glTF Transform, 16 the most
/// that their integers hold.
const LEVELS: [u32; 3] = [12, 14, 16];

/// Returns the coarsest of 23, 16, 14 and 12 bits at which all faces of nonzero orientation keep it.
///
/// - 23 bits: it is kept when every coordinate is rounded to the nearest multiple of 2⁻²³. This is the grid that this
///   program writes; coordinates on it do not move.
/// - b = 16, 14, 12: it is kept however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶. That covers every
///   quantizer that rounds to i/(2ᵇ−1) and stores the result in 16 bits, over the unit square or over a smaller box.
///
/// Decided in integers. Coordinates that are not multiples of 2⁻⁴⁰ are truncated and the move is allowed for, so that a
/// doubt is never resolved in favor of the map.
pub(crate) fn coarsest_bits(topology: &UvTopology) -> Option<u32> {
    if topology.uvs.iter().any(is_far) {
        return None;
    }
    let coarsest = LEVELS
        .into_iter()
        .find(|bits: &u32| doubtful_faces(topology, *bits).next().is_none());
    coarsest.or_else(|| {
        oriented(topology)
            .all(|(_, uvs, sign)| survives(&steps(uvs, sign), 0))
            .then_some(23)
    })
}

/// Iterates over the faces whose orientation is in doubt when each coordinate moves by up to the move of `bits`, and
/// those too far out to judge.
fn doubtful_faces(topology: &UvTopology, bits: u32) -> impl Iterator<Item = u32> {
    let delta = allowance(bits);
    oriented(topology)
        .filter(move |(_, uvs, sign)| is_far(uvs) || !survives(&units(uvs, *sign), delta))
        .map(|(face, ..)| face)
}

fn is_far(uvs: &CornerUvs) -> bool {
    uvs.as_flattened().iter().any(|x| x.abs() >= LIMIT)
}

/// Iterates over index, corners and orientation of the faces that have an orientation.
fn oriented(topology: &UvTopology) -> impl Iterator<Item = (u32, &CornerUvs, i8)> {
    let faces = (0..).zip(&topology.uvs).zip(&topology.orientation);
    faces
        .filter(|(_, sign)| **sign != 0)
        .map(|((face, uvs), &sign)| (face, uvs, sign))
}

/// Returns the move 1/(2(2ᵇ−1)) + 2⁻¹⁶ of each coordinate that a map must survive to hold at b bits.
fn largest_move(bits: u32) -> f64 {
    0.5 / (f64::from(bits).exp2() - 1.0) + f64::from(-16).exp2()
}

/// Returns the [`largest_move`] in units of 2⁻⁴⁰, rounded up, plus one for the coordinate's own rounding.
fn allowance(bits: u32) -> i128 {
    let steps = 2 * ((1_i128 << bits) - 1);
    ((1_i128 << UNIT_BITS) + steps - 1) / steps + (1 << (UNIT_BITS - 16)) + 1
}

/// Returns corners truncated to multiples of 2⁻⁴⁰, counter-clockwise, relative to the first.
fn units(uvs: &CornerUvs, sign: i8) -> [Fixed; 3] {
    relative(uvs.map(fixed), sign)
}

/// Returns corners rounded to multiples of 2⁻²³, counter-clockwise, relative to the first.
fn steps(uvs: &CornerUvs, sign: i8) -> [Fixed; 3] {
    relative(
        uvs.map(|p| p.map(|x| (x * f64::from(1 << 23)).round() as i128)),
        sign,
    )
}

fn relative([a, b, c]: [Fixed; 3], sign: i8) -> [Fixed; 3] {
    let corners = if sign > 0 { [a, b, c] } else { [a, c, b] };
    corners.map(|p| difference(p, a))
}

/// Returns whether a triangle with its first corner at the origin stays positive however each coordinate moves by up to
/// `delta`.
///
/// With y fixed the doubled area is linear in x, and its minimum over the moves of x is Σ xᵢ(yᵢ₊₁−yᵢ₊₂) − 2δ(max y −
/// min y). That is concave in y, so its own minimum lies at one of the eight corners of the moves of y.
fn survives(p: &[Fixed; 3], delta: i128) -> bool {
    let doubled_area = cross(p[1], p[2]);
    let ranges = range(p.map(|p| p[0])) + range(p.map(|p| p[1]));
    if doubled_area - 2 * delta * ranges - 4 * delta * delta > 0 {
        return true; // no move changes the area by more
    }
    (0..8_u32).all(|corner| {
        let y = [0, 1, 2].map(|k| p[k][1] + if corner >> k & 1 == 1 { delta } else { -delta });
        let doubled_area = p[1][0] * (y[2] - y[0]) + p[2][0] * (y[0] - y[1]);
        doubled_area - 2 * delta * range(y) > 0
    })
}

fn range([a, b, c]: [i128; 3]) -> i128 {
    a.max(b).max(c) - a.min(b).min(c)
}

// Stability of a map under rounding to a number of bits.

/// Verdict on the bijectivity of a map whose coordinates move by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶ each, decided in integers.
///
/// This covers every quantizer that rounds to i/(2ᵇ−1) and stores 16 bits, over the unit square or a
/// smaller box.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BitsVerdict {
    /// The requested bits b.
    pub asked: u32,
    /// `true` if it is proven that the map is bijective and that every orientation and separation is kept.
    pub hold: bool,
    /// Faces whose orientation is in doubt.
    pub faces_in_doubt: usize,
    /// Pairs of chart edges that may touch.
    pub pairs_in_doubt: u64,
    /// The first few faces in doubt.
    pub offending_faces: Vec<u32>,
    /// The faces of the first few pairs in doubt.
    pub offending_pairs: Vec<[u32; 2]>,
}

pub(super) fn judge_bits(
    topology: &UvTopology,
    boundary: &ChartBoundary,
    asked: u32,
    is_bijective: bool,
) -> BitsVerdict {
    let faces: Vec<u32> = doubtful_faces(topology, asked).collect();
    let (mut pairs_in_doubt, mut offending_pairs) = (0, Vec::new());
    let visit = doubtful_pairs(boundary, asked, |pair| {
        pairs_in_doubt += 1;
        if offending_pairs.len() < NAMED {
            offending_pairs.push(pair);
        }
    });
    let is_separate = pairs_in_doubt == 0 && visit == BoxVisit::Complete;
    BitsVerdict {
        asked,
        hold: is_bijective && is_separate && faces.is_empty(),
        faces_in_doubt: faces.len(),
        pairs_in_doubt,
        offending_faces: faces.into_iter().take(NAMED).collect(),
        offending_pairs,
    }
}

/// Returns the coarsest of 16, 14 and 12 bits at which a bijective map stays so, given that its orientations are kept
/// at `grid_bits`.
pub(super) fn coarsest_safe_bits(boundary: &ChartBoundary, grid_bits: u32) -> Option<u32> {
    let levels = LEVELS.into_iter().filter(|&bits| bits >= grid_bits);
    levels.into_iter().find(|&bits| {
        let mut is_separate = true;
        let visit = doubtful_pairs(boundary, bits, |_| is_separate = false);
        is_separate && visit == BoxVisit::Complete
    })
}

// Pairs of edges that stay apart however their ends move.

/// Visits the pairs of boundary edges that may meet when each coordinate moves by up to the move of `bits`.
///
/// As long as all faces stay positive, faces of an injective map can come to overlap only after boundary edges of
/// charts touch. So a map without such a pair stays injective. Ends that are one vertex with one UV move together.
fn doubtful_pairs(
    boundary: &ChartBoundary,
    bits: u32,
    mut visit: impl FnMut([u32; 2]),
) -> BoxVisit {
    let delta = allowance(bits);
    // The boxes that can be reached, and a little more.
    boundary.near_pairs(1.001 * largest_move(bits), |a, b| {
        if !stay_apart(a, b, delta) {
            visit([a.face, b.face]);
        }
    })
}

fn stay_apart(a: &BoundaryEdge, b: &BoundaryEdge, delta: i128) -> bool {
    let shared = |i: usize, j: usize| a.vertices[i] == b.vertices[j] && a.uvs[i] == b.uvs[j];
    let ends = [[0, 0], [0, 1], [1, 0], [1, 1]];
    match ends.into_iter().find(|&[i, j]| shared(i, j)) {
        // They would have to point the same way: then the end of the shorter lies on the longer.
        Some([i, j]) => {
            let [a, b] = [(a, 1 - i), (b, 1 - j)].map(|(edge, end)| (edge.uvs[end], edge.uvs));
            let is_clear = |end, edge: [[f64; 2]; 2]| {
                keep_their_distance([fixed(end); 2], edge.map(fixed), delta)
            };
            is_clear(a.0, b.1) && is_clear(b.0, a.1)
        }
        None => keep_their_distance(a.uvs.map(fixed), b.uvs.map(fixed), delta),
    }
}

/// Returns whether two segments have no common point however each coordinate of their ends moves by up to `delta`.
///
/// They can have one if and only if one segment, moved as a whole by up to 2δ along each axis, can meet the other: then
/// a point of each can move to the middle, with all ends. The shifts at which they meet form a polygon whose sides run
/// along the segments and the axes; zero lies outside if and only if it does so beyond one of these sides.
fn keep_their_distance(a: [Fixed; 2], b: [Fixed; 2], delta: i128) -> bool {
    let normal = |[p, q]: [Fixed; 2]| [p[1] - q[1], q[0] - p[0]];
    [[1, 0], [0, 1], normal(a), normal(b)].into_iter().any(|n| {
        let range = |s: [Fixed; 2]| {
            let [p, q] = s.map(|p| dot(n, p));
            [p.min(q), p.max(q)]
        };
        let ([low_a, high_a], [low_b, high_b]) = (range(a), range(b));
        (low_a - high_b).max(low_b - high_a) > 2 * delta * taxicab(n)
    })
}
