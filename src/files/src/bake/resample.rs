//! A texture for a new UV map from textures on the old one.

use super::Texture;
use super::color::{decoded, encoded};
use super::coverage::Coverage;
use super::fill::filled;
use super::plane::Plane;
use super::size::Areas;
use super::triangle::{Triangle, blended};
use crate::picture::Image;
use rayon::prelude::*;
use std::borrow::Cow;

/// Most samples per texel along a side: if the source is finer still, it repeats more often than the new texture can
/// show.
const MOST_SAMPLES: f64 = 8.0;
/// Samples along a side for a source with nearest-texel filtering: they smooth the edges of its steps.
const STEP_SAMPLES: f64 = 4.0;
/// Relative tolerance by which a source texel may be smaller than a target texel before more samples are taken.
const SLACK: f64 = 0.01;

/// Color of a texture without any covered texel.
const BLACK: [u8; 4] = [0, 0, 0, 255];

/// Bakes the new texture.
pub fn baked(plane: &Plane, coverage: &Coverage) -> Image {
    let side = coverage.side();
    let numbers = 0..plane.textures.len();
    let reduced: Vec<Reduced> = numbers.map(|n| Reduced::new(plane, n, coverage)).collect();
    let bake = Resampling {
        plane,
        textures: &reduced,
        coverage,
    };
    let mut texels: Vec<Option<[u8; 4]>> = vec![None; side * side];
    texels
        .par_chunks_mut(side)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                *texel = bake.texel([x, y]);
            }
        });
    Image {
        width: side,
        height: side,
        pixels: filled(texels, side, BLACK),
    }
}

/// Inputs of the texels.
struct Resampling<'a> {
    plane: &'a Plane<'a>,
    textures: &'a [Reduced<'a>],
    coverage: &'a Coverage,
}

impl Resampling<'_> {
    /// Computes the value of a texel: the mean over its square, which is cut off at the face if it lies at a border.
    fn texel(&self, [x, y]: [usize; 2]) -> Option<[u8; 4]> {
        // Find the face of the texel and its place in the source.
        let face = self.coverage.at(x, y)?;
        let sampled = self.plane.faces[face as usize].as_ref()?;
        let reduced = &self.textures[sampled.texture as usize];
        let texture = reduced.texture();
        let source = sampled
            .corners
            .map(|place| place.map(|x| x * reduced.scale));
        let triangle = Triangle::new(*self.coverage.corners(face))?;
        // Average samples over the texel; at a border, those beside the face move to its nearest point.
        let is_interior = self.coverage.is_interior(x, y);
        let center = [x as f64 + 0.5, y as f64 + 0.5];
        let n = samples(&triangle.jacobian(&source), texture.is_nearest);
        let mut sum = [0.0; 4];
        for k in 0..n * n {
            let offset = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
            let place = [center[0] + offset(k % n), center[1] + offset(k / n)];
            let weights = if is_interior {
                triangle.weights(place)
            } else {
                triangle.nearest(place).0
            };
            let value = texture.sample(blended(weights, &source));
            sum = [0, 1, 2, 3].map(|c| sum[c] + value[c]);
        }
        let mut value = sum.map(|c| c / (n * n) as f32);
        // Turn a direction from the old tangent frame to the new one.
        if let Some(frames) = &self.plane.frames {
            let [x, y, z, a] = value;
            let (weights, _) = triangle.nearest(center);
            let [x, y, z] = frames.carried(face as usize, weights, [x, y, z]);
            value = [x, y, z, a];
        }
        Some(encoded(value, self.plane.encoding))
    }
}

/// Returns the number of samples of a texel along a side: one for each source texel along its length.
fn samples(jacobian: &[[f64; 2]; 2], is_nearest: bool) -> usize {
    let [[a, b], [c, d]] = *jacobian;
    let squares = a * a + b * b + c * c + d * d;
    let determinant = a * d - b * c;
    let spread = (squares * squares - 4.0 * determinant * determinant).max(0.0);
    let length = (0.5 * (squares + spread.sqrt())).sqrt();
    let least = if is_nearest { STEP_SAMPLES } else { 1.0 };
    (length - SLACK).ceil().max(least).min(MOST_SAMPLES) as usize
}

// Reduction of repeating textures that are much finer than the target.

/// Source texels per target texel, along a side, from which the source is halved; at least two are left.
const FINE: f64 = 4.0;
/// Number of repetitions from which a texture is taken to have no chart borders that halving could mix.
const REPEATS: f64 = 2.0;

/// A texture at a size that suits the target.
struct Reduced<'a> {
    image: Cow<'a, Image>,
    texture: Texture<'a>,
    /// Length of an original texel as a share of one of the reduced texture.
    pub scale: f64,
}

impl<'a> Reduced<'a> {
    /// Reduces texture `number` of a plane: one that repeats is halved as long as its faces do not need it finer and
    /// its sides are even.
    pub fn new(plane: &Plane<'a>, number: usize, coverage: &Coverage) -> Self {
        let texture = plane.textures[number];
        let faces = (0..).zip(&plane.faces).filter_map(|(face, sampled)| {
            let sampled = sampled.as_ref()?;
            let is_own = sampled.texture as usize == number;
            is_own.then(|| (&sampled.corners, coverage.corners(face)))
        });
        let areas = Areas::of(faces);
        let [width, height] = texture.size();
        let repeats = 0.5 * areas.sources >= REPEATS * width * height;
        let mut image = Cow::Borrowed(texture.image);
        let mut scale = 1.0;
        while repeats
            && areas.length() * scale >= FINE
            && image.width.is_multiple_of(2)
            && image.height.is_multiple_of(2)
        {
            image = Cow::Owned(halved(&image, texture));
            scale *= 0.5;
        }
        Self {
            image,
            texture,
            scale,
        }
    }

    pub fn texture(&self) -> Texture<'_> {
        Texture {
            image: &self.image,
            ..self.texture
        }
    }
}

/// Returns the means of two by two texels.
fn halved(image: &Image, texture: Texture) -> Image {
    let (width, height) = (image.width / 2, image.height / 2);
    let mean = |x: usize, y: usize| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| {
            let pixel = image.pixels[(2 * y + dy) * image.width + 2 * x + dx];
            decoded(pixel, texture.encoding)
        });
        let mean = [0, 1, 2, 3].map(|c| 0.25 * four.iter().map(|value| value[c]).sum::<f32>());
        encoded(mean, texture.encoding)
    };
    Image {
        width,
        height,
        pixels: (0..width * height)
            .map(|k| mean(k % width, k / width))
            .collect(),
    }
}
