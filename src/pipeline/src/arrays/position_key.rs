//! Positions that are one.

/// What equal positions have in common.
pub type PositionKey = [u64; 3];

/// A position by its bits, −0 = 0.
pub fn position_key(position: [f64; 3]) -> PositionKey {
    position.map(|x| (x + 0.0).to_bits())
}
