//! A picture at several scales, sampled between its pixels.

use super::Image;

/// Red, green and blue times alpha, and alpha, from 0 to 1.
pub(super) type Premultiplied = [f32; 4];

/// A coarser copy: red, green and blue times alpha, and alpha, from 0 to 65535.
struct Level {
    width: usize,
    height: usize,
    pixels: Vec<[u16; 4]>,
}

/// A picture and its halvings, computed on demand.
pub(super) struct Mipmaps<'a> {
    image: &'a Image,
    /// Levels from 1 on; level 0 is the picture itself.
    halved: Vec<Level>,
}

impl<'a> Mipmaps<'a> {
    pub fn new(image: &'a Image) -> Self {
        Self {
            image,
            halved: Vec::new(),
        }
    }

    /// Computes the levels up to `level`, fewer if a picture of one pixel is reached; returns the last one available.
    pub fn up_to(&mut self, level: usize) -> usize {
        while self.halved.len() < level {
            let finest = self.halved.len();
            let [width, height] = self.size(finest);
            if width.max(height) <= 1 {
                break;
            }
            let coarser = self.halving(finest);
            self.halved.push(coarser);
        }
        level.min(self.halved.len())
    }

    /// Returns columns and rows of a level.
    fn size(&self, level: usize) -> [usize; 2] {
        match level.checked_sub(1) {
            None => [self.image.width, self.image.height],
            Some(k) => [self.halved[k].width, self.halved[k].height],
        }
    }

    fn pixel(&self, level: usize, x: usize, y: usize) -> Premultiplied {
        if let Some(k) = level.checked_sub(1) {
            let level = &self.halved[k];
            return level.pixels[y * level.width + x].map(|c| f32::from(c) / 65535.0);
        }
        let [r, g, b, a] =
            self.image.pixels[y * self.image.width + x].map(|c| f32::from(c) / 255.0);
        [r * a, g * a, b * a, a]
    }

    /// Averages two by two pixels; at odd sizes the last column or row counts twice.
    fn halving(&self, level: usize) -> Level {
        let [w, h] = self.size(level);
        let (width, height) = (w.div_ceil(2), h.div_ceil(2));
        let average = |x: usize, y: usize| {
            let (x2, y2) = ((2 * x + 1).min(w - 1), (2 * y + 1).min(h - 1));
            let four = [(2 * x, 2 * y), (x2, 2 * y), (2 * x, y2), (x2, y2)];
            let sum = four
                .map(|(x, y)| self.pixel(level, x, y))
                .into_iter()
                .fold([0.0; 4], |sum, p| mix(sum, p, 1.0));
            sum.map(|c| (c * 0.25 * 65535.0).round() as u16)
        };
        Level {
            width,
            height,
            pixels: (0..width * height)
                .map(|k| average(k % width, k / width))
                .collect(),
        }
    }

    /// Returns the color at a place in pixels of the picture, linear between pixel centers, constant beyond the
    /// outermost ones.
    pub fn sample(&self, level: usize, at: [f64; 2]) -> Premultiplied {
        let size = self.size(level);
        let scale = 0.5_f64.powi(level as i32);
        let (mut low, mut high, mut part) = ([0; 2], [0; 2], [0.0; 2]);
        for k in 0..2 {
            let last = (size[k] - 1) as f64;
            let x = (at[k] * scale - 0.5).clamp(0.0, last);
            low[k] = x as usize;
            high[k] = (low[k] + 1).min(size[k] - 1);
            part[k] = (x - x.floor()) as f32;
        }
        let corner = |x: usize, y: usize| self.pixel(level, x, y);
        let row = |y: usize| between(corner(low[0], y), corner(high[0], y), part[0]);
        between(row(low[1]), row(high[1]), part[1])
    }
}

/// Returns a + t b.
pub(super) fn mix(a: Premultiplied, b: Premultiplied, t: f32) -> Premultiplied {
    [0, 1, 2, 3].map(|k| a[k] + t * b[k])
}

/// Returns (1 − t) a + t b.
fn between(a: Premultiplied, b: Premultiplied, t: f32) -> Premultiplied {
    [0, 1, 2, 3].map(|k| a[k] + t * (b[k] - a[k]))
}
