//! Pictures deformed with a mesh.
//!
//! Each deformed triangle is filled with the content of its rest shape: the center of every pixel in it is mapped back
//! by the triangle's affine map, and the picture is sampled there. Where the picture shrinks, a coarser copy is chosen
//! by the smaller of the two scales, and several samples are taken along the direction of the greater one, as graphics
//! hardware does. Colors are mixed as stored (sRGB), premultiplied by alpha, so that transparent pixels contribute no
//! color.

use super::raster::{spans, steps};
use super::{Image, ImageError};
use unwrapd_method::numerics::vec2::{cross, sub};

/// Most samples per pixel, the usual limit of anisotropic filtering; stronger shrinking in one direction only is
/// undersampled.
const MOST_SAMPLES: f64 = 16.0;
/// Longest side of a warped picture, and most pixels in it: as many as a picture that is read may have.
const LONGEST: f64 = 65_536.0;
const MOST_PIXELS: f64 = 1e8;

/// Triangles over a picture in pixels, with (0, 0) at its upper left corner, and their deformed positions.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<'a> {
    /// Vertices on the picture.
    pub rest: &'a [[f64; 2]],
    /// Positions of these vertices afterward; finite.
    pub deformed: &'a [[f64; 2]],
    /// Three vertices per triangle.
    pub triangles: &'a [[u32; 3]],
}

/// Part of the plane that a warped picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The area of the original picture.
    Source,
    /// The whole deformed mesh.
    Mesh,
}

/// A warped picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warped {
    /// Pixels; transparent where there is no triangle.
    pub image: Image,
    /// Position of the upper left corner, in pixels of the original.
    pub origin: [i64; 2],
}

/// Warps the picture. A triangle covers the pixels whose centers it contains; later ones lie over earlier ones.
pub fn warped(
    image: &Image,
    deformation: &Deformation,
    extent: Extent,
) -> Result<Warped, ImageError> {
    let (origin, mut result) = frame(image, deformation.deformed, extent)?;
    if image.pixels.is_empty() {
        return Ok(Warped {
            image: result,
            origin,
        });
    }
    let mut mipmaps = Mipmaps::new(image);
    let shift = origin.map(|x| x as f64);
    // Map each pixel of a triangle back to its rest shape, and sample the picture there.
    for triangle in deformation.triangles {
        let from = triangle.map(|v| deformation.rest[v as usize]);
        let to = triangle.map(|v| sub(deformation.deformed[v as usize], shift));
        let Some(inverse) = Inverse::new(from, to) else {
            continue;
        };
        let footprint = Footprint::of(&inverse, &mut mipmaps);
        for (row, columns) in spans(steps(to), [result.width, result.height]) {
            for column in columns {
                let center = inverse.at([column as f64 + 0.5, row as f64 + 0.5]);
                let color = footprint.sample(&mipmaps, center);
                result.pixels[row * result.width + column] = stored(color);
            }
        }
    }
    Ok(Warped {
        image: result,
        origin,
    })
}

/// Returns the upper left corner and the empty picture.
fn frame(
    image: &Image,
    deformed: &[[f64; 2]],
    extent: Extent,
) -> Result<([i64; 2], Image), ImageError> {
    if extent == Extent::Source || deformed.is_empty() {
        return Ok(([0; 2], Image::transparent(image.width, image.height)));
    }
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in deformed {
        for k in 0..2 {
            low[k] = low[k].min(p[k].floor());
            high[k] = high[k].max(p[k].ceil());
        }
    }
    let size = sub(high, low);
    let fits = low.iter().all(|x| x.abs() < 1e9)
        && size.iter().all(|&s| s <= LONGEST)
        && size[0] * size[1] <= MOST_PIXELS;
    if !fits {
        let [width, height] = size.map(|s| s as u32);
        return Err(ImageError::TooLarge { width, height });
    }
    let [width, height] = size.map(|s| s as usize);
    Ok((low.map(|x| x as i64), Image::transparent(width, height)))
}

/// The affine map from a deformed triangle back to its rest shape.
struct Inverse {
    rest: [f64; 2],
    deformed: [f64; 2],
    /// Images of a step to the right and of a step down.
    columns: [[f64; 2]; 2],
}

impl Inverse {
    /// Creates the map; returns `None` if the deformed triangle has no area.
    fn new(rest: [[f64; 2]; 3], deformed: [[f64; 2]; 3]) -> Option<Self> {
        let [u, v] = [1, 2].map(|k| sub(deformed[k], deformed[0]));
        let [p, q] = [1, 2].map(|k| sub(rest[k], rest[0]));
        let area = cross(u, v);
        // x = (x × v / area) u + (u × x / area) v.
        let image = |x: [f64; 2]| {
            let (s, t) = (cross(x, v) / area, cross(u, x) / area);
            [s * p[0] + t * q[0], s * p[1] + t * q[1]]
        };
        let columns = [image([1.0, 0.0]), image([0.0, 1.0])];
        let is_finite = columns.as_flattened().iter().all(|x| x.is_finite());
        (area != 0.0 && is_finite).then_some(Self {
            rest: rest[0],
            deformed: deformed[0],
            columns,
        })
    }

    fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let d = sub(point, self.deformed);
        [0, 1].map(|k| self.rest[k] + d[0] * self.columns[0][k] + d[1] * self.columns[1][k])
    }
}

/// The part of the picture that one pixel shows.
struct Footprint {
    level: usize,
    n_samples: usize,
    /// Vector from the first sample to the end of the last one's share.
    along: [f64; 2],
}

impl Footprint {
    fn of(inverse: &Inverse, mipmaps: &mut Mipmaps) -> Self {
        // The ellipse that a pixel's circle goes to: axes of M Mᵀ = [a b; b c].
        let [x, y] = inverse.columns;
        let (a, b, c) = (
            x[0] * x[0] + y[0] * y[0],
            x[0] * x[1] + y[0] * y[1],
            x[1] * x[1] + y[1] * y[1],
        );
        let (mean, radius) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
        let greater = (mean + radius).sqrt();
        let smaller = (mean - radius).max(0.0).sqrt();
        let angle = 0.5 * (2.0 * b).atan2(a - c);
        // As fine as the smaller axis allows, coarser only if the greater one would need too many samples.
        let scale = smaller.max(greater / MOST_SAMPLES).max(1.0);
        let level = mipmaps.up_to(scale.log2().floor() as usize);
        let samples = (greater * 0.5_f64.powi(level as i32)).ceil();
        Self {
            level,
            n_samples: samples.clamp(1.0, 2.0 * MOST_SAMPLES) as usize,
            along: [greater * angle.cos(), greater * angle.sin()],
        }
    }

    fn sample(&self, mipmaps: &Mipmaps, center: [f64; 2]) -> Premultiplied {
        let n = self.n_samples as f64;
        let mut sum = [0.0; 4];
        for k in 0..self.n_samples {
            let t = (k as f64 + 0.5) / n - 0.5;
            let at = [0, 1].map(|axis| center[axis] + t * self.along[axis]);
            sum = mix(sum, mipmaps.sample(self.level, at), 1.0 / n as f32);
        }
        sum
    }
}

/// Converts a pixel to its stored form.
fn stored([r, g, b, a]: Premultiplied) -> [u8; 4] {
    let byte = |x: f32| (x * 255.0).round() as u8;
    if a <= 0.0 {
        return [0; 4];
    }
    [byte(r / a), byte(g / a), byte(b / a), byte(a)]
}

// A picture at several scales, sampled between its pixels.

/// Red, green and blue times alpha, and alpha, from 0 to 1.
type Premultiplied = [f32; 4];

/// A coarser copy: red, green and blue times alpha, and alpha, from 0 to 65535.
struct MipmapLevel {
    width: usize,
    height: usize,
    pixels: Vec<[u16; 4]>,
}

/// A picture and its halvings, computed on demand.
struct Mipmaps<'a> {
    image: &'a Image,
    /// Levels from 1 on; level 0 is the picture itself.
    halved: Vec<MipmapLevel>,
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
    fn halving(&self, level: usize) -> MipmapLevel {
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
        MipmapLevel {
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
fn mix(a: Premultiplied, b: Premultiplied, t: f32) -> Premultiplied {
    [0, 1, 2, 3].map(|k| a[k] + t * b[k])
}

/// Returns (1 − t) a + t b.
fn between(a: Premultiplied, b: Premultiplied, t: f32) -> Premultiplied {
    [0, 1, 2, 3].map(|k| a[k] + t * (b[k] - a[k]))
}
