//! A picture with the settings of its sampler.

use crate::document::{Encoding, Wrap};
use crate::picture::Image;
use std::sync::LazyLock;

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

// Texels as numbers that can be averaged.

/// Conversion of sRGB codes, as defined in IEC 61966-2-1, to linear light.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let c = code as f64 / 255.0;
        let linear = if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        };
        linear as f32
    })
});

/// Decodes a texel: colors in linear light, data unchanged, directions in [−1, 1]. The fourth channel is always data.
pub(super) fn decoded([r, g, b, a]: [u8; 4], encoding: Encoding) -> [f32; 4] {
    let part = |code: u8| f32::from(code) / 255.0;
    let channel = |code: u8| match encoding {
        Encoding::Color => LINEAR[code as usize],
        Encoding::Data => part(code),
        Encoding::Normal => 2.0 * part(code) - 1.0,
    };
    [channel(r), channel(g), channel(b), part(a)]
}

/// Encodes values as the nearest texel.
pub(super) fn encoded([r, g, b, a]: [f32; 4], encoding: Encoding) -> [u8; 4] {
    let code = |part: f32| (part.clamp(0.0, 1.0) * 255.0).round() as u8;
    let channel = |value: f32| match encoding {
        Encoding::Color => code(srgb(value)),
        Encoding::Data => code(value),
        Encoding::Normal => code(0.5 * value + 0.5),
    };
    [channel(r), channel(g), channel(b), code(a)]
}

fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}
