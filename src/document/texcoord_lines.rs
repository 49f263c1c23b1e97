//! The `vt` lines of an OBJ file, one for each pair of vertex and UV.
use std::collections::HashMap;
use std::io::Write as _;

/// `vt` lines in the order of their first use.
pub(super) struct TexcoordLines {
    grid_bits: u32,
    numbers: HashMap<(u32, [i32; 2]), u32>,
    /// The lines so far.
    pub text: Vec<u8>,
}

impl TexcoordLines {
    /// No lines; coordinates to come are in units of 2⁻ᵏ for k = `grid_bits`.
    pub fn new(grid_bits: u32) -> Self {
        Self {
            grid_bits,
            numbers: HashMap::new(),
            text: Vec::new(),
        }
    }

    /// The number, from 1, of the line for a corner. The decimals written are the shortest that give the grid point
    /// again, exactly, whether they are read as f32 or f64.
    pub fn number(&mut self, vertex: u32, uv: [i32; 2], line_end: &str) -> u32 {
        let next = self.numbers.len() as u32 + 1;
        let number = *self.numbers.entry((vertex, uv)).or_insert(next);
        if number == next {
            let [u, v] = uv.map(|i| f64::from(i) / f64::from(1_u32 << self.grid_bits));
            // Writing to memory does not fail.
            let _ = write!(self.text, "vt {u} {v}{line_end}");
        }
        number
    }
}

/// The decimal that stands for a coordinate in a text file: read as f32 it is `x`, and equal coordinates have equal texts.
pub(super) fn decimal(x: f32) -> String {
    x.to_string()
}
