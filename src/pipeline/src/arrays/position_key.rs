//! Keys of equal positions.

/// Key that equal positions share.
pub type PositionKey = [u64; 3];

/// Returns the key of a position: its bits, with −0 = 0.
pub fn position_key(position: [f64; 3]) -> PositionKey {
    position.map(|x| (x + 0.0).to_bits())
}
