//! Encoding of JPEG files.

use super::image::Image;
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// Quality, of 100: textures are mostly seen larger than a pixel per texel, and are resampled from compressed ones.
const QUALITY: u8 = 92;

impl Image {
    /// Returns the picture as a JPEG file, with colors at full resolution; `None` if some pixel is transparent, which
    /// JPEG cannot store.
    pub fn jpeg(&self) -> Option<Vec<u8>> {
        let opaque = self
            .pixels
            .iter()
            .map(|&[r, g, b, a]| (a == u8::MAX).then_some([r, g, b]));
        let rgb: Vec<[u8; 3]> = opaque.collect::<Option<_>>()?;
        let (width, height) = (self.width as u32, self.height as u32);
        let mut file = Vec::new();
        let encoder = JpegEncoder::new_with_quality(&mut file, QUALITY);
        // Only a picture with a side of more than 65,535 pixels has no JPEG file.
        let written =
            encoder.write_image(rgb.as_flattened(), width, height, ExtendedColorType::Rgb8);
        written.is_ok().then_some(file)
    }
}
