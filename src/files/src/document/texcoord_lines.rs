//! The `vt` lines of an OBJ file, one for each pair of vertex and UV.
use std::collections::HashMap;
use std::io::Write as _;

/// `vt` lines in the order of their first use.
#[derive(Default)]
pub(super) struct TexcoordLines {
    numbers: HashMap<(u32, [u32; 2]), u32>,
    /// Text of the lines so far.
    pub text: Vec<u8>,
}

impl TexcoordLines {
    /// Returns the number, from 1, of the line for a corner. Writes the shortest decimals that give the UV again,
    /// exactly, whether they are read as f32 or f64.
    pub fn number(&mut self, vertex: u32, uv: [f32; 2], line_end: &str) -> u32 {
        let next = self.numbers.len() as u32 + 1;
        let key = (vertex, uv.map(f32::to_bits));
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            let [u, v] = uv.map(f64::from);
            // Writing to memory does not fail.
            let _ = write!(self.text, "vt {u} {v}{line_end}");
        }
        number
    }
}

/// Returns the decimal for a coordinate in a text file: read as f32 it is `x`, and equal coordinates have equal texts.
pub(super) fn decimal(x: f32) -> String {
    x.to_string()
}
