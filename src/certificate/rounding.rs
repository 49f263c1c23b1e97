//! How coarsely UVs may be rounded before an orientation is in doubt.

use super::CornerUvs;
use super::topology::UvTopology;

/// The integers of this file count units of 2⁻⁴⁰.
const UNIT_BITS: u32 = 40;

/// Coordinates from here on are not judged; it keeps all products within i128 with room to spare.
const LIMIT: f64 = (1 << 20) as f64;

/// The coarsest of 23, 16, 14 and 12 bits at which all faces of non-zero orientation keep it.
///
/// - 23 bits: it is kept when every coordinate is rounded to the nearest multiple of 2⁻²³. This is the grid this program writes;
///   coordinates on it do not move.
/// - b = 16, 14, 12: it is kept however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶. That covers every quantizer that rounds
///   to i/(2ᵇ−1) and stores the result in 16 bits, over the unit square or over a smaller box.
///
/// Decided in integers. Coordinates that are no multiples of 2⁻⁴⁰ are cut to it and the move is allowed for, so that
/// a doubt is never resolved in favour of the map.
pub(crate) fn coarsest_bits(topology: &UvTopology) -> Option<u32> {
    let far = |uvs: &CornerUvs| uvs.as_flattened().iter().any(|x| x.abs() >= LIMIT);
    if topology.uvs.iter().any(far) {
        return None;
    }
    let mut levels = vec![
        (16, allowance(16)),
        (14, allowance(14)),
        (12, allowance(12)),
    ];
    for (uvs, sign) in oriented(topology) {
        let face = units(uvs, sign);
        while levels
            .last()
            .is_some_and(|&(_, delta)| !survives(&face, delta))
        {
            levels.pop();
        }
    }
    let on_grid = |(uvs, sign)| survives(&steps(uvs, sign), 0);
    levels
        .last()
        .map(|&(bits, _)| bits)
        .or_else(|| oriented(topology).all(on_grid).then_some(23))
}

/// Corners and orientation of the faces that have one.
fn oriented(topology: &UvTopology) -> impl Iterator<Item = (&CornerUvs, i8)> {
    let signs = topology.orientation.iter().copied();
    topology
        .uvs
        .iter()
        .zip(signs)
        .filter(|(_, sign)| *sign != 0)
}

/// 1/(2(2ᵇ−1)) + 2⁻¹⁶ in units of 2⁻⁴⁰, rounded up, and one more for the coordinate's own rounding.
fn allowance(bits: u32) -> i128 {
    let steps = 2 * ((1_i128 << bits) - 1);
    ((1_i128 << UNIT_BITS) + steps - 1) / steps + (1 << (UNIT_BITS - 16)) + 1
}

/// Corners cut to multiples of 2⁻⁴⁰, counter-clockwise, relative to the first.
fn units(uvs: &CornerUvs, sign: i8) -> [[i128; 2]; 3] {
    relative(
        uvs.map(|p| p.map(|x| (x * (1_u64 << UNIT_BITS) as f64) as i128)),
        sign,
    )
}

/// Corners rounded to multiples of 2⁻²³, counter-clockwise, relative to the first.
fn steps(uvs: &CornerUvs, sign: i8) -> [[i128; 2]; 3] {
    relative(
        uvs.map(|p| p.map(|x| (x * f64::from(1 << 23)).round() as i128)),
        sign,
    )
}

fn relative([a, b, c]: [[i128; 2]; 3], sign: i8) -> [[i128; 2]; 3] {
    let corners = if sign > 0 { [a, b, c] } else { [a, c, b] };
    corners.map(|p| [p[0] - a[0], p[1] - a[1]])
}

/// Whether a triangle whose first corner is the origin stays positive however each coordinate moves by up to `delta`.
///
/// With y fixed the doubled area is linear in x, and its minimum over the moves of x is Σ xᵢ(yᵢ₊₁−yᵢ₊₂) − 2δ(max y − min y). That is
/// concave in y, so its own minimum lies at one of the eight corners of the moves of y.
fn survives(p: &[[i128; 2]; 3], delta: i128) -> bool {
    let doubled_area = p[1][0] * p[2][1] - p[2][0] * p[1][1];
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
