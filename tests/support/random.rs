//! Numbers that look random and are the same each time.

/// A multiplicative generator of numbers below 1 (Lehmer 1951).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0 * 48_271 % 0x7fff_ffff;
        self.0 as f64 / f64::from(0x7fff_ffff)
    }

    pub fn place(&mut self, size: [f64; 2]) -> [f64; 2] {
        [self.next() * size[0], self.next() * size[1]]
    }
}
