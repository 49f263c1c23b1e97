//! A picture with the settings of its sampler.

use super::color::decoded;
use crate::document::{Encoding, Wrap};
use crate::picture::Image;

/// A picture with the settings of its sampler.
#[derive(Clone, Copy)]
pub struct Texture<'a> {
    /// The texels.
    pub image: &'a Image,
    /// Encoding of the texels.
    pub encoding: Encoding,
    /// Wrapping beyond the picture's left and right, and beyond its top and bottom.
    pub wrap: [Wrap; 2],
    /// `true` for the nearest texel, `false` for a weighted mean of four.
    pub is_nearest: bool,
}

impl Texture<'_> {
    /// Returns columns and rows.
    pub fn size(&self) -> [f64; 2] {
        [self.image.width as f64, self.image.height as f64]
    }

    /// Returns the value at a place in texels, linear between their centers.
    pub(super) fn sample(&self, [x, y]: [f64; 2]) -> [f32; 4] {
        let (width, height) = (self.image.width, self.image.height);
        if self.is_nearest {
            let x = wrapped(split(x).0, width, self.wrap[0]);
            return self.texel(x, wrapped(split(y).0, height, self.wrap[1]));
        }
        let ((x, s), (y, t)) = (split(x - 0.5), split(y - 0.5));
        let columns = [x, x + 1].map(|x| wrapped(x, width, self.wrap[0]));
        let rows = [y, y + 1].map(|y| wrapped(y, height, self.wrap[1]));
        let row = |y: usize| {
            let [a, b] = columns.map(|x| self.texel(x, y));
            between(a, b, s)
        };
        between(row(rows[0]), row(rows[1]), t)
    }

    fn texel(&self, x: usize, y: usize) -> [f32; 4] {
        decoded(self.image.pixels[y * self.image.width + x], self.encoding)
    }
}

/// Limit of coordinates: they fit an `i64`, and beyond it the fractions of an `f64` are no finer than eighths.
const FARTHEST: f64 = 1e15;

/// Splits a number into its floor and the rest; NaN becomes 0.
fn split(x: f64) -> (i64, f32) {
    let x = x.clamp(-FARTHEST, FARTHEST);
    let toward_zero = x as i64;
    let whole = toward_zero - i64::from(x < toward_zero as f64);
    (whole, (x - whole as f64) as f32)
}

/// Returns the texel, of `n`, that an integer coordinate refers to.
fn wrapped(x: i64, n: usize, wrap: Wrap) -> usize {
    let size = n as i64;
    if (0..size).contains(&x) {
        return x as usize;
    }
    let within = match wrap {
        Wrap::Repeat => x.rem_euclid(size),
        Wrap::Mirror => {
            let x = x.rem_euclid(2 * size);
            x.min(2 * size - 1 - x)
        }
        Wrap::Clamp => x.clamp(0, size - 1),
    };
    within as usize
}

/// Returns (1 − t) a + t b.
fn between(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| a[k] + t * (b[k] - a[k]))
}
