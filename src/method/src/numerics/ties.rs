//! Rounding that makes equals tie.

/// Bits of the mantissa that are left: a thousandth is far above the rounding of files, and no reason to cut elsewhere. Not tuned.
const BITS: u32 = 10;
/// Size below which a quantity is rounding.
const NOTHING: f64 = 1e-9;

/// Rounds a quantity that decisions compare, so that parts that are equal but for rounding errors tie. The caller then decides by
/// something stable, such as their order. Sums of rounded quantities are exact.
pub fn tied(x: f64) -> f64 {
    if x.abs() < NOTHING {
        return 0.0;
    }
    let half = 1_u64 << (51 - BITS);
    f64::from_bits((x.to_bits() + half) & !(2 * half - 1))
}
