//! Small copies of pictures, for lists.

use super::{Image, ImageError};
use image::RgbaImage;
use image::imageops;

/// Length of the shorter side in pixels: on a sheet of several squares, each remains visible.
const SIDE: u32 = 72;

/// Returns a small PNG of a picture; one that is already small keeps its size.
pub fn thumbnail_png(picture: &[u8]) -> Result<Vec<u8>, ImageError> {
    let image = Image::decode(picture)?;
    let [width, height] = [image.width as u32, image.height as u32];
    let least = width.min(height).max(1);
    let reduced = |side: u32| (u64::from(side) * u64::from(SIDE) / u64::from(least)) as u32;
    let pixels = image.pixels.into_flattened();
    let small = match RgbaImage::from_raw(width, height, pixels) {
        Some(picture) if SIDE < least => {
            imageops::thumbnail(&picture, reduced(width), reduced(height))
        }
        Some(picture) => picture,
        None => RgbaImage::default(),
    };
    let small = Image {
        width: small.width() as usize,
        height: small.height() as usize,
        pixels: small.as_raw().as_chunks().0.to_vec(),
    };
    Ok(small.png())
}
