//! Positions that are one.

/// A position by its bits, −0 = 0.
pub fn position_key(position: [f32; 3]) -> [u32; 3] {
    position.map(|x| (x + 0.0).to_bits())
}
