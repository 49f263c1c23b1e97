//! A picture with the settings of its sampler.

use crate::document::{Encoding, Tint, Wrap};
use crate::picture::{Image, Picture};
use std::sync::LazyLock;

/// A picture with the settings of its sampler, and a map of its values.
#[derive(Clone, Copy)]
pub struct Texture<'a> {
    /// The texels.
    pub picture: &'a Picture,
    /// Encoding of the texels.
    pub encoding: Encoding,
    /// Wrapping beyond the picture's left and right, and beyond its top and bottom.
    pub wrap: [Wrap; 2],
    /// `true` for the nearest texel, `false` for a weighted mean of four.
    pub is_nearest: bool,
    /// Map of the decoded values.
    pub tint: Tint,
}

impl Texture<'_> {
    /// Returns whether it has one value everywhere, so that no size of a new texture loses any detail.
    pub(super) fn is_constant(&self) -> bool {
        self.picture.size() == [1, 1]
    }

    /// Returns whether two textures have the same value at every place.
    pub(super) fn shows_as(&self, other: &Self) -> bool {
        std::ptr::eq(self.picture, other.picture)
            && (self.wrap, self.is_nearest, self.tint) == (other.wrap, other.is_nearest, other.tint)
    }

    /// Returns columns and rows.
    pub fn size(&self) -> [f64; 2] {
        self.picture.size().map(|n| n as f64)
    }

    /// Returns the value at a place in texels, linear between their centers.
    pub(super) fn sample(&self, [x, y]: [f64; 2]) -> [f32; 4] {
        if self.is_nearest {
            return self.texel_at([split(x).0, split(y).0]);
        }
        let [width, height] = self.picture.size();
        let ((x, s), (y, t)) = (split(x - 0.5), split(y - 0.5));
        let columns = [x, x + 1].map(|x| wrapped(x, width, self.wrap[0]));
        let rows = [y, y + 1].map(|y| wrapped(y, height, self.wrap[1]));
        let row = |y: usize| {
            let [a, b] = columns.map(|x| self.texel(x, y));
            between(a, b, s)
        };
        between(row(rows[0]), row(rows[1]), t)
    }

    /// Returns the value of a texel by its column and row, which are wrapped.
    pub(super) fn texel_at(&self, [x, y]: [i64; 2]) -> [f32; 4] {
        let [width, height] = self.picture.size();
        let x = wrapped(x, width, self.wrap[0]);
        self.texel(x, wrapped(y, height, self.wrap[1]))
    }

    fn texel(&self, x: usize, y: usize) -> [f32; 4] {
        let value = match self.picture {
            Picture::Eight(image) => decoded(pixel(image, x, y), self.encoding),
            Picture::Sixteen(image) => decoded(pixel(image, x, y), self.encoding),
        };
        self.tint.applied(value)
    }
}

/// Returns the pixel in a column and a row.
pub(super) fn pixel<T: Copy>(image: &Image<T>, x: usize, y: usize) -> [T; 4] {
    image.pixels[y * image.width + x]
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

/// A channel of 8 or 16 bits.
pub trait Channel: Copy + Send + Sync + 'static {
    /// Largest code.
    const MOST: u32;
    /// Returns the code as a number.
    fn code(self) -> u32;
    /// Returns the channel with a code up to [`MOST`](Self::MOST).
    fn of_code(code: u32) -> Self;
    /// Converts sRGB to linear light.
    fn linear(self) -> f32;
}

/// Conversion of sRGB codes of 8 bits to linear light.
static LINEAR_8: LazyLock<Vec<f32>> = LazyLock::new(|| linear_codes(u8::MOST));
/// Conversion of sRGB codes of 16 bits to linear light.
static LINEAR_16: LazyLock<Vec<f32>> = LazyLock::new(|| linear_codes(u16::MOST));

impl Channel for u8 {
    const MOST: u32 = u8::MAX as u32;
    fn code(self) -> u32 {
        u32::from(self)
    }
    fn of_code(code: u32) -> Self {
        code as Self
    }
    fn linear(self) -> f32 {
        LINEAR_8[self as usize]
    }
}

impl Channel for u16 {
    const MOST: u32 = u16::MAX as u32;
    fn code(self) -> u32 {
        u32::from(self)
    }
    fn of_code(code: u32) -> Self {
        code as Self
    }
    fn linear(self) -> f32 {
        LINEAR_16[self as usize]
    }
}

/// Returns the linear light of all sRGB codes up to `most`, as defined in IEC 61966-2-1.
fn linear_codes(most: u32) -> Vec<f32> {
    let linear = |code: u32| {
        let c = f64::from(code) / f64::from(most);
        let linear = if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        };
        linear as f32
    };
    (0..=most).map(linear).collect()
}

/// Decodes a texel: colors in linear light, data unchanged, directions in [−1, 1]. The fourth channel is always data.
pub(super) fn decoded<T: Channel>([r, g, b, a]: [T; 4], encoding: Encoding) -> [f32; 4] {
    let part = |channel: T| channel.code() as f32 / T::MOST as f32;
    let value = |channel: T| match encoding {
        Encoding::Color => channel.linear(),
        Encoding::Data => part(channel),
        Encoding::Normal => 2.0 * part(channel) - 1.0,
    };
    [value(r), value(g), value(b), part(a)]
}

/// Encodes values as the nearest texel. Returns every decoded texel of the same bits unchanged.
pub(super) fn encoded<T: Channel>([r, g, b, a]: [f32; 4], encoding: Encoding) -> [T; 4] {
    let code = |part: f32| T::of_code((part.clamp(0.0, 1.0) * T::MOST as f32).round() as u32);
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
