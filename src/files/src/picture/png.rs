//! Encoding of PNG files.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// Returns the file of `width` × `height` pixels, row by row from the top, with `bytes` in the format `color`.
pub(super) fn png(bytes: &[u8], width: usize, height: usize, color: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    let written = PngEncoder::new(&mut file).write_image(bytes, width as u32, height as u32, color);
    // Writing to memory fails for wrong dimensions only.
    debug_assert!(written.is_ok());
    file
}
