//! Coarsest rounding of UVs that keeps every orientation.

use super::fixed::{Fixed, UNIT_BITS, cross, difference, fixed};
use super::topology::UvTopology;
use crate::mesh::CornerUvs;

/// Coordinates from here on are not judged. Below, 2²⁰ · 2⁴⁰ units give sums of products up to 2¹²³, within `i128`.
const LIMIT: f64 = (1 << 20) as f64;

/// Bits to which files are quantized, the coarsest first: 12 is the default of gltfpack and glTF Transform, 16 the most
/// that their integers hold.
pub(super) const LEVELS: [u32; 3] = [12, 14, 16];

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
    let kept_at = |bits: &u32| doubtful_faces(topology, *bits).next().is_none();
    let on_grid = |(_, uvs, sign)| survives(&steps(uvs, sign), 0);
    let coarsest = LEVELS.into_iter().find(kept_at);
    coarsest.or_else(|| oriented(topology).all(on_grid).then_some(23))
}

/// Iterates over the faces whose orientation is in doubt when each coordinate moves by up to the move of `bits`, and
/// those too far out to judge.
pub(super) fn doubtful_faces(topology: &UvTopology, bits: u32) -> impl Iterator<Item = u32> {
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
pub(super) fn largest_move(bits: u32) -> f64 {
    0.5 / (f64::from(bits).exp2() - 1.0) + f64::from(-16).exp2()
}

/// Returns the [`largest_move`] in units of 2⁻⁴⁰, rounded up, plus one for the coordinate's own rounding.
pub(super) fn allowance(bits: u32) -> i128 {
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
