//! Coordinates as integers, so that distances and moves are compared without rounding.

/// Bits of the unit: integer coordinates count multiples of 2⁻⁴⁰. Fine enough that `f32` coordinates from 2⁻¹⁷ on are
/// exact, coarse enough for products in `i128`.
pub(super) const UNIT_BITS: u32 = 40;

/// A point in these units.
pub(super) type Fixed = [i128; 2];

/// Truncates a point to multiples of the unit, toward zero. f32 numbers from 2⁻¹⁷ on are such multiples.
pub(super) fn fixed(point: [f64; 2]) -> Fixed {
    point.map(|x| (x * (1_u64 << UNIT_BITS) as f64) as i128)
}

/// Returns whether truncation loses nothing.
pub(super) fn is_exact(point: [f64; 2]) -> bool {
    point.iter().all(|x| {
        let units = x * (1_u64 << UNIT_BITS) as f64;
        units == units.trunc()
    })
}

pub(super) fn difference(a: Fixed, b: Fixed) -> Fixed {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn dot(a: Fixed, b: Fixed) -> i128 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: Fixed, b: Fixed) -> i128 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns the sum of the absolute coordinates.
pub(super) fn taxicab(a: Fixed) -> i128 {
    a[0].abs() + a[1].abs()
}

/// Returns all 256 bits of a product, the high half first, so that products compare as they are.
pub(super) fn product(a: u128, b: u128) -> [u128; 2] {
    const LOW: u128 = u64::MAX as u128;
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    let (high, middle, other, low) = (a1 * b1, a1 * b0, a0 * b1, a0 * b0);
    let carried = (low >> 64) + (middle & LOW) + (other & LOW);
    [
        high + (middle >> 64) + (other >> 64) + (carried >> 64),
        carried << 64 | low & LOW,
    ]
}
