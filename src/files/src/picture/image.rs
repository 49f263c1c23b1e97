//! Pictures with transparency, from and to files.

use super::png::png;
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageReader, Limits};
use std::io::Cursor;

/// Largest file, in bytes: photographs take a tenth of it.
const MOST_FILE_BYTES: usize = 64 << 20;
/// Most pixels of a picture, 400 MB at 8 bits per channel; more are refused before decoding.
const MOST_PIXELS: u64 = 100_000_000;
/// Most bytes that a decoder may allocate: the picture at 16 bits per channel, and the same again.
const MOST_BYTES: u64 = 16 * MOST_PIXELS;

/// Reason why a picture cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImageError {
    /// The file is neither PNG nor JPEG.
    #[error("the picture is not PNG or JPEG")]
    UnknownFormat,
    /// The file has too many bytes.
    #[error("the picture has {0} bytes; the limit is 64 MiB")]
    TooManyBytes(usize),
    /// The picture has too many pixels.
    #[error("the picture has {width} × {height} pixels; the limit is 100 megapixels")]
    TooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The file is damaged.
    #[error("invalid picture: {0}")]
    Invalid(String),
}

impl ImageError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownFormat => "unknown_format",
            Self::TooManyBytes(_) | Self::TooLarge { .. } => "image_too_large",
            Self::Invalid(_) => "invalid_image",
        }
    }
}

/// Pixels of red, green, blue and alpha (not premultiplied), row 0 at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width` × `height` pixels, row by row.
    pub pixels: Vec<[u8; 4]>,
}

impl Image {
    /// Creates a transparent picture.
    pub fn transparent(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![[0; 4]; width * height],
        }
    }

    /// Decodes a PNG or JPEG file, turned upright according to its metadata; more than 8 bits per channel are rounded.
    pub fn decode(bytes: &[u8]) -> Result<Self, ImageError> {
        if bytes.len() > MOST_FILE_BYTES {
            return Err(ImageError::TooManyBytes(bytes.len()));
        }
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| unreadable(error.into()))?;
        if reader.format().is_none() {
            return Err(ImageError::UnknownFormat);
        }
        let mut limits = Limits::no_limits();
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(unreadable)?;
        let (width, height) = decoder.dimensions();
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(ImageError::TooLarge { width, height });
        }
        let orientation = decoder.orientation().map_err(unreadable)?;
        let mut decoded = DynamicImage::from_decoder(decoder).map_err(unreadable)?;
        decoded.apply_orientation(orientation);
        let rgba = decoded.into_rgba8();
        Ok(Self {
            width: rgba.width() as usize,
            height: rgba.height() as usize,
            pixels: rgba.as_raw().as_chunks::<4>().0.to_vec(),
        })
    }

    /// Returns the PNG file.
    pub fn png(&self) -> Vec<u8> {
        let bytes = self.pixels.as_flattened();
        png(bytes, self.width, self.height, ExtendedColorType::Rgba8)
    }
}

fn unreadable(error: image::ImageError) -> ImageError {
    match error {
        image::ImageError::Unsupported(_) => ImageError::UnknownFormat,
        error => ImageError::Invalid(error.to_string()),
    }
}
