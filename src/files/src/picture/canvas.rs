//! Pixels: blending, lines, copying, and the final PNG.

use super::color::{BACKGROUND, Rgb, mix};
use super::png::png;
use image::ExtendedColorType;

/// A picture, row 0 at the top.
pub(super) struct Canvas {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Rgb>,
}

impl Canvas {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![BACKGROUND; width * height],
        }
    }

    /// Fills the pixels of a rectangle, clipped at the borders.
    pub fn fill(
        &mut self,
        columns: std::ops::Range<usize>,
        rows: std::ops::Range<usize>,
        color: Rgb,
    ) {
        for row in rows.start..rows.end.min(self.height) {
            for column in columns.start..columns.end.min(self.width) {
                self.pixels[row * self.width + column] = color;
            }
        }
    }

    /// Copies `other` with its upper left corner to `(column, row)`; it must fit.
    pub fn place(&mut self, other: &Canvas, column: usize, row: usize) {
        for (k, line) in other.pixels.chunks(other.width.max(1)).enumerate() {
            let start = (row + k) * self.width + column;
            self.pixels[start..start + line.len()].copy_from_slice(line);
        }
    }

    /// Blends the lines of a mask over the picture.
    pub fn ink(&mut self, lines: &Lines, color: Rgb, opacity: f32) {
        for (pixel, &coverage) in self.pixels.iter_mut().zip(&lines.coverage) {
            if coverage > 0 {
                *pixel = mix(*pixel, color, f32::from(coverage) / 255.0 * opacity);
            }
        }
    }

    /// Returns the PNG file.
    pub fn png(&self) -> Vec<u8> {
        let bytes = self.pixels.as_flattened();
        png(bytes, self.width, self.height, ExtendedColorType::Rgb8)
    }
}

/// Coverage of each pixel by lines; where lines meet it is their maximum, not their sum.
pub(super) struct Lines {
    width: usize,
    height: usize,
    coverage: Vec<u8>,
}

impl Lines {
    pub fn new(canvas: &Canvas) -> Self {
        Self {
            width: canvas.width,
            height: canvas.height,
            coverage: vec![0; canvas.width * canvas.height],
        }
    }

    /// Draws a segment with round ends; coordinates are in pixels, and pixel (0, 0) has its center at (0.5, 0.5).
    pub fn segment(&mut self, a: [f64; 2], b: [f64; 2], thickness: f64) {
        let reach = 0.5 * thickness + 0.5;
        let d = [b[0] - a[0], b[1] - a[1]];
        let length_squared = d[0] * d[0] + d[1] * d[1];
        let rows = span(a[1].min(b[1]) - reach, a[1].max(b[1]) + reach, self.height);
        for row in rows {
            let y = row as f64 + 0.5;
            for column in self.columns_near(a, d, y, reach) {
                let p = [column as f64 + 0.5 - a[0], y - a[1]];
                let t = if length_squared > 0.0 {
                    ((p[0] * d[0] + p[1] * d[1]) / length_squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let distance = (p[0] - t * d[0]).hypot(p[1] - t * d[1]);
                let covered =
                    ((reach - distance).clamp(0.0, 1.0) * thickness.min(1.0) * 255.0) as u8;
                let pixel = &mut self.coverage[row * self.width + column];
                *pixel = covered.max(*pixel);
            }
        }
    }

    /// Returns the columns of row `y` that the part of the segment near that row can touch.
    fn columns_near(&self, a: [f64; 2], d: [f64; 2], y: f64, reach: f64) -> std::ops::Range<usize> {
        let at = |y: f64| (((y - a[1]) / d[1]).clamp(0.0, 1.0)) * d[0] + a[0];
        let (from, to) = if d[1].abs() > 1e-9 {
            (at(y - reach), at(y + reach))
        } else {
            (a[0], a[0] + d[0])
        };
        span(from.min(to) - reach, from.max(to) + reach, self.width)
    }
}

/// Returns the pixels, of `n`, that an interval touches.
fn span(from: f64, to: f64, n: usize) -> std::ops::Range<usize> {
    let end = (to.ceil().max(0.0) as usize).min(n);
    (from.floor().max(0.0) as usize).min(end)..end
}
