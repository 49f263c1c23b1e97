//! A texture for a new UV map from textures on the old one.

use super::coverage::{Areas, Coverage, Triangle, blended};
use super::moves::{WholeMove, whole_moves};
use super::plane::Plane;
use super::texture::{Channel, Texture, decoded, encoded, pixel};
use crate::document::Encoding;
use crate::picture::{Image, Picture};
use rayon::prelude::*;

/// Most samples per texel along a side: if the source is finer still, it repeats more often than the new texture can
/// show.
const MOST_SAMPLES: f64 = 8.0;
/// Samples along a side for a source with nearest-texel filtering: they smooth the edges of its steps.
const STEP_SAMPLES: f64 = 4.0;
/// Relative tolerance by which a source texel may be smaller than a target texel before more samples are taken.
const SLACK: f64 = 0.01;

/// Bakes the new texture: copies the texels of islands that have moved by whole texels, and resamples the others.
pub fn baked<T: Channel>(plane: &Plane, coverage: &Coverage) -> Image<T> {
    let side = coverage.side();
    let numbers = 0..plane.textures.len();
    let reduced: Vec<Reduced> = numbers.map(|n| Reduced::new(plane, n, coverage)).collect();
    let bake = Resampling {
        plane,
        textures: &reduced,
        moves: &whole_moves(plane, coverage),
        coverage,
    };
    let mut texels: Vec<Option<[T; 4]>> = vec![None; side * side];
    texels
        .par_chunks_mut(side)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                *texel = bake.texel([x, y]);
            }
        });
    let [zero, most] = [0, T::MOST].map(T::of_code);
    let black = [zero, zero, zero, most];
    Image {
        width: side,
        height: side,
        pixels: filled(texels, side, black),
    }
}

/// Inputs of the texels.
struct Resampling<'a> {
    plane: &'a Plane<'a>,
    textures: &'a [Reduced<'a>],
    /// Move of each face that has moved with its island by whole texels.
    moves: &'a [Option<WholeMove>],
    coverage: &'a Coverage,
}

impl Resampling<'_> {
    /// Computes the value of a texel: the mean over its square, which is cut off at the face if it lies at a border.
    fn texel<T: Channel>(&self, [x, y]: [usize; 2]) -> Option<[T; 4]> {
        // Find the face of the texel and its place in the source.
        let face = self.coverage.at(x, y)?;
        let sampled = self.plane.faces[face as usize].as_ref()?;
        let moved = self.moves[face as usize].filter(|moved| moved.keeps_directions);
        if let Some(moved) = moved {
            let texture = &self.plane.textures[sampled.texture as usize];
            let value = texture.texel_at(moved.source([x, y]));
            let value = self.colored(face, [x, y], value)?;
            return Some(encoded(value, self.plane.encoding));
        }
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
            let value = self.plane.colored(face as usize, weights, value);
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

    /// Returns a texel's value multiplied by the color at its center; `None` if the face has no area.
    fn colored(&self, face: u32, [x, y]: [usize; 2], value: [f32; 4]) -> Option<[f32; 4]> {
        if self.plane.colors.is_none() {
            return Some(value);
        }
        let triangle = Triangle::new(*self.coverage.corners(face))?;
        let (weights, _) = triangle.nearest([x as f64 + 0.5, y as f64 + 0.5]);
        Some(self.plane.colored(face as usize, weights, value))
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
    /// The reduced texels; `None` if the texture is not reduced.
    halved: Option<Picture>,
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
        let mut reduced = Self {
            halved: None,
            texture,
            scale: 1.0,
        };
        while repeats && areas.length() * reduced.scale >= FINE {
            let picture = reduced.texture().picture;
            if !picture.size().iter().all(|n| n.is_multiple_of(2)) {
                break;
            }
            let halved = match picture {
                Picture::Eight(image) => Picture::Eight(halved(image, texture.encoding)),
                Picture::Sixteen(image) => Picture::Sixteen(halved(image, texture.encoding)),
            };
            reduced.halved = Some(halved);
            reduced.scale *= 0.5;
        }
        reduced
    }

    pub fn texture(&self) -> Texture<'_> {
        Texture {
            picture: self.halved.as_ref().unwrap_or(self.texture.picture),
            ..self.texture
        }
    }
}

/// Returns the means of two by two texels.
fn halved<T: Channel>(image: &Image<T>, encoding: Encoding) -> Image<T> {
    let (width, height) = (image.width / 2, image.height / 2);
    let mean = |x: usize, y: usize| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(dx, dy)| decoded(pixel(image, 2 * x + dx, 2 * y + dy), encoding));
        let mean = [0, 1, 2, 3].map(|c| 0.25 * four.iter().map(|value| value[c]).sum::<f32>());
        encoded(mean, encoding)
    };
    Image {
        width,
        height,
        pixels: (0..width * height)
            .map(|k| mean(k % width, k / width))
            .collect(),
    }
}

// Textures of attributes of the corners of faces.

/// Bakes a number of the corners of each face, such as an attribute of their vertices, for every texel, row by row:
/// interpolated at the texel's center in its face, at the nearest point if the center lies beside the face, and filled
/// from the neighbors between charts.
pub fn baked_attribute(coverage: &Coverage, corners: &[[f32; 3]]) -> Vec<f32> {
    let side = coverage.side();
    let texel = |x: usize, y: usize| {
        let face = coverage.at(x, y)?;
        let triangle = Triangle::new(*coverage.corners(face))?;
        let (weights, _) = triangle.nearest([x as f64 + 0.5, y as f64 + 0.5]);
        let values = corners[face as usize];
        let value: f64 = (weights.iter().zip(values))
            .map(|(weight, value)| weight * f64::from(value))
            .sum();
        Some(value as f32)
    };
    let mut texels = vec![None; side * side];
    (texels.par_chunks_mut(side).enumerate()).for_each(|(y, row)| {
        for (x, value) in row.iter_mut().enumerate() {
            *value = texel(x, y);
        }
    });
    filled(texels, side, 0.0)
}

// Texels between charts.

/// Values that can be averaged to fill texels between charts.
pub(super) trait Mean: Copy {
    /// Returns the mean; `None` without values.
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self>;
}

impl<T: Channel> Mean for [T; 4] {
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self> {
        let (mut sum, mut n) = ([0_u32; 4], 0);
        for value in values {
            for (sum, channel) in sum.iter_mut().zip(value) {
                *sum += channel.code();
            }
            n += 1;
        }
        (n > 0).then(|| sum.map(|s| T::of_code((s + n / 2) / n)))
    }
}

impl Mean for f32 {
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self> {
        let (sum, n) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value, n + 1.0));
        (n > 0.0).then(|| sum / n)
    }
}

/// Fills the texels without a value from those with one, ring by ring: each gets the mean of its neighbors of earlier
/// rings. A texture without any value becomes `blank`.
pub(super) fn filled<T: Mean>(texels: Vec<Option<T>>, side: usize, blank: T) -> Vec<T> {
    let mut texels = texels;
    let mut ring: Vec<usize> = (0..texels.len())
        .filter(|&texel| texels[texel].is_none() && mean(&texels, side, texel).is_some())
        .collect();
    while !ring.is_empty() {
        let values: Vec<Option<T>> = ring.iter().map(|&t| mean(&texels, side, t)).collect();
        for (&texel, value) in ring.iter().zip(values) {
            texels[texel] = value;
        }
        let mut next: Vec<usize> = ring
            .iter()
            .flat_map(|&texel| around(side, texel))
            .filter(|&texel| texels[texel].is_none())
            .collect();
        next.sort_unstable();
        next.dedup();
        ring = next;
    }
    texels.into_iter().map(|t| t.unwrap_or(blank)).collect()
}

/// Returns the mean of the neighbors that have a value.
fn mean<T: Mean>(texels: &[Option<T>], side: usize, texel: usize) -> Option<T> {
    T::mean(around(side, texel).filter_map(|neighbor| texels[neighbor]))
}

/// Iterates over the up to eight neighbors of a texel.
fn around(side: usize, texel: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (texel % side, texel / side);
    let near = move |c: usize| c.saturating_sub(1)..=(c + 1).min(side - 1);
    near(y)
        .flat_map(move |y| near(x).map(move |x| y * side + x))
        .filter(move |&neighbor| neighbor != texel)
}
