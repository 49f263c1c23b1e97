//! How coarsely UVs may be rounded before an orientation is in doubt.

use super::CornerUvs;

/// The integers of this file count units of 2⁻⁴⁰.
const UNIT_BITS: i32 = 40;

/// Coordinates from here on are not judged; it keeps all products within i128 with room to spare.
const LIMIT: f64 = (1 << 20) as f64;

/// The coarsest of 23, 16, 14 and 12 bits at which all `faces` (given with their orientation, not zero) keep it.
///
/// - 23 bits: it is kept when every coordinate is rounded to the nearest multiple of 2⁻²³. This is the grid this program writes;
///   coordinates on it do not move.
/// - b = 16, 14, 12: it is kept however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶. That covers every quantizer that rounds
///   to i/(2ᵇ−1) and stores the result in 16 bits, over the unit square or over a smaller box.
///
/// Decided in integers. Coordinates that are no multiples of 2⁻⁴⁰ are rounded to it and the move is allowed for, so that
/// a doubt is never resolved in favour of the map.
pub(crate) fn coarsest_bits(faces: &[(CornerUvs, i8)]) -> Option<u32> {
    let far = |uvs: &CornerUvs| uvs.as_flattened().iter().any(|x| x.abs() >= LIMIT);
    if faces.is_empty() || faces.iter().any(|(uvs, _)| far(uvs)) {
        return None;
    }
    let coarsest_by_moving = [16, 14, 12].into_iter().take_while(|&bits| {
        faces
            .iter()
            .all(|(uvs, sign)| survives(&units(uvs, *sign, UNIT_BITS), allowance(bits)))
    });
    coarsest_by_moving.last().or_else(|| {
        let survives_rounding = |(uvs, sign): &(CornerUvs, i8)| survives(&units(uvs, *sign, 23), 0);
        faces.iter().all(survives_rounding).then_some(23)
    })
}

/// 1/(2(2ᵇ−1)) + 2⁻¹⁶ in units of 2⁻⁴⁰, rounded up, and one more for the coordinate's own rounding.
fn allowance(bits: u32) -> i128 {
    let steps = 2 * ((1_i128 << bits) - 1);
    ((1_i128 << UNIT_BITS) + steps - 1) / steps + (1 << (UNIT_BITS - 16)) + 1
}

/// Corners rounded to multiples of 2^−`bits`, reordered to be counter-clockwise, relative to the first.
fn units(&[a, b, c]: &CornerUvs, sign: i8, bits: i32) -> [[i128; 2]; 3] {
    let round = |p: [f64; 2]| p.map(|x| (x * f64::from(bits).exp2()).round() as i128);
    let corners = if sign > 0 { [a, b, c] } else { [a, c, b] }.map(round);
    corners.map(|p| [p[0] - corners[0][0], p[1] - corners[0][1]])
}

/// Whether a triangle stays positive however each of its coordinates moves by up to `delta`.
///
/// With y fixed the doubled area is linear in x, and its minimum over the moves of x is Σ xᵢ(yᵢ₊₁−yᵢ₊₂) − 2δ(max y − min y). That is
/// concave in y, so its own minimum lies at one of the eight corners of the moves of y.
fn survives(p: &[[i128; 2]; 3], delta: i128) -> bool {
    (0..8_u32).all(|corner| {
        let y = [0, 1, 2].map(|k| p[k][1] + if corner >> k & 1 == 1 { delta } else { -delta });
        let doubled_area =
            p[0][0] * (y[1] - y[2]) + p[1][0] * (y[2] - y[0]) + p[2][0] * (y[0] - y[1]);
        let range = y[0].max(y[1]).max(y[2]) - y[0].min(y[1]).min(y[2]);
        doubled_area - 2 * delta * range > 0
    })
}
