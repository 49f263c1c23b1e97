//! Rounding that makes equals tie.

/// Bits of the mantissa that are left.
const BITS: u32 = 10;
/// Size below which a quantity is rounding.
const NOTHING: f64 = 1e-9;

/// Rounds a quantity that decides, so that parts that are equal but for the rounding of their vertices tie, and something other than
/// rounding decides between them, such as the order in which they come. Sums of rounded quantities have no rounding of their own.
pub fn tied(x: f64) -> f64 {
    if x.abs() < NOTHING {
        return 0.0;
    }
    let half = 1_u64 << (51 - BITS);
    f64::from_bits((x.to_bits() + half) & !(2 * half - 1))
}
