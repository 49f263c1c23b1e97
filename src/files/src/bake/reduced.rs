//! Reduction of repeating textures that are much finer than the target.

use std::borrow::Cow;

use super::color::{decoded, encoded};
use super::coverage::Coverage;
use super::size::Areas;
use super::{Plane, Texture};
use crate::picture::Image;

/// Source texels per target texel, along a side, from which the source is halved.
const FINE: f64 = 4.0;
/// Number of repetitions from which a texture is taken to have no chart borders that halving could mix.
const REPEATS: f64 = 2.0;

/// A texture at a size that suits the target.
pub(super) struct Reduced<'a> {
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
