//! Pictures with transparency, from and to files.

use super::ktx2;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::webp::WebPEncoder;
use image::{
    DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageReader, Limits, RgbaImage,
    imageops,
};
use std::io::Cursor;

/// Largest file, in bytes: photographs take a tenth of it.
const MOST_FILE_BYTES: usize = 64 << 20;
/// Most pixels of a picture, 400 MB at 8 bits per channel; more are refused before decoding.
const MOST_PIXELS: u64 = 100_000_000;
/// Most bytes that a decoder may allocate: the picture at 16 bits per channel, and the same again.
const MOST_BYTES: u64 = 16 * MOST_PIXELS;

/// Reason why a picture cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The file is neither PNG, JPEG nor `WebP`.
    #[error("the picture is not PNG, JPEG or WebP")]
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

/// Pixels of red, green, blue and alpha (not premultiplied), row 0 at the top; `T` is `u8` or `u16`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image<T = u8> {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width` × `height` pixels, row by row.
    pub pixels: Vec<[T; 4]>,
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

    /// Decodes a PNG, JPEG or `WebP` file, turned upright according to its metadata; more than 8 bits per channel are
    /// rounded.
    pub fn decode(bytes: &[u8]) -> Result<Self, ImageError> {
        Ok(Self::of(decoded(bytes)?))
    }

    fn of(decoded: DynamicImage) -> Self {
        let rgba = decoded.into_rgba8();
        Self {
            width: rgba.width() as usize,
            height: rgba.height() as usize,
            pixels: rgba.as_raw().as_chunks().0.to_vec(),
        }
    }

    /// Returns the PNG file.
    pub fn png(&self) -> Vec<u8> {
        let bytes = self.pixels.as_flattened();
        png(bytes, self.width, self.height, ExtendedColorType::Rgba8)
    }

    /// Returns the lossless `WebP` file; `None` if a side has more than 16,384 pixels.
    pub fn webp(&self) -> Option<Vec<u8>> {
        let mut file = Vec::new();
        let (width, height) = (self.width as u32, self.height as u32);
        let bytes = self.pixels.as_flattened();
        let encoder = WebPEncoder::new_lossless(&mut file);
        let written = encoder.write_image(bytes, width, height, ExtendedColorType::Rgba8);
        written.is_ok().then_some(file)
    }
}

impl Image<u16> {
    /// Returns the PNG file of 16 bits per channel.
    pub fn png(&self) -> Vec<u8> {
        let channels = self.pixels.as_flattened().iter();
        let bytes: Vec<u8> = channels.flat_map(|channel| channel.to_ne_bytes()).collect();
        png(&bytes, self.width, self.height, ExtendedColorType::Rgba16)
    }
}

/// Decodes a PNG, JPEG or `WebP` file, turned upright according to its metadata.
fn decoded(bytes: &[u8]) -> Result<DynamicImage, ImageError> {
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
    checked_size(width, height)?;
    let orientation = decoder.orientation().map_err(unreadable)?;
    let mut decoded = DynamicImage::from_decoder(decoder).map_err(unreadable)?;
    decoded.apply_orientation(orientation);
    Ok(decoded)
}

/// Returns the columns and rows of a picture, unless it has too many pixels.
fn checked_size(width: u32, height: u32) -> Result<[u32; 2], ImageError> {
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(ImageError::TooLarge { width, height });
    }
    Ok([width, height])
}

/// Returns columns and rows of a PNG, JPEG, `WebP` or KTX2 file as stored, without decoding its pixels.
pub fn picture_size(bytes: &[u8]) -> Result<[u32; 2], ImageError> {
    if ktx2::is_ktx2(bytes) {
        return ktx2_size(bytes);
    }
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let size = reader.map_err(|error| unreadable(error.into()))?;
    let (width, height) = size.into_dimensions().map_err(unreadable)?;
    Ok([width, height])
}

fn ktx2_size(bytes: &[u8]) -> Result<[u32; 2], ImageError> {
    let size = ktx2::size(bytes);
    let [width, height] =
        size.ok_or_else(|| invalid_ktx2("its header is cut off or has no size"))?;
    checked_size(width, height)
}

fn invalid_ktx2(reason: &str) -> ImageError {
    ImageError::Invalid(format!("KTX2: {reason}"))
}

// Pictures with the bits of their files.

/// A picture with 8 or 16 bits per channel, as its file has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Picture {
    /// 8 bits per channel.
    Eight(Image),
    /// 16 bits per channel.
    Sixteen(Image<u16>),
}

impl Picture {
    /// Decodes a PNG, JPEG or `WebP` file, turned upright according to its metadata, or a KTX2 file of glTF; pixels of 16
    /// bits stay so.
    pub fn decode(bytes: &[u8]) -> Result<Self, ImageError> {
        if ktx2::is_ktx2(bytes) {
            let size = ktx2_size(bytes)?;
            let pixels = ktx2::pixels(bytes, size).map_err(|reason| invalid_ktx2(&reason))?;
            let [width, height] = size.map(|side| side as usize);
            return Ok(Self::Eight(Image {
                width,
                height,
                pixels,
            }));
        }
        let decoded = decoded(bytes)?;
        let is_deep = matches!(
            decoded,
            DynamicImage::ImageLuma16(_)
                | DynamicImage::ImageLumaA16(_)
                | DynamicImage::ImageRgb16(_)
                | DynamicImage::ImageRgba16(_)
        );
        if !is_deep {
            return Ok(Self::Eight(Image::of(decoded)));
        }
        let rgba = decoded.into_rgba16();
        Ok(Self::Sixteen(Image {
            width: rgba.width() as usize,
            height: rgba.height() as usize,
            pixels: rgba.as_raw().as_chunks().0.to_vec(),
        }))
    }

    /// Returns columns and rows.
    pub fn size(&self) -> [usize; 2] {
        match self {
            Self::Eight(image) => [image.width, image.height],
            Self::Sixteen(image) => [image.width, image.height],
        }
    }

    /// Returns the number of bytes of the pixels.
    pub fn n_bytes(&self) -> usize {
        match self {
            Self::Eight(image) => size_of_val(image.pixels.as_slice()),
            Self::Sixteen(image) => size_of_val(image.pixels.as_slice()),
        }
    }

    /// Returns the PNG file, with the bits of the picture.
    pub fn png(&self) -> Vec<u8> {
        match self {
            Self::Eight(image) => image.png(),
            Self::Sixteen(image) => image.png(),
        }
    }
}

fn unreadable(error: image::ImageError) -> ImageError {
    match error {
        image::ImageError::Unsupported(_) => ImageError::UnknownFormat,
        error => ImageError::Invalid(error.to_string()),
    }
}

// Encoding of PNG files.

/// Returns the file of `width` × `height` pixels, row by row from the top, with `bytes` in the format `color`.
pub(super) fn png(bytes: &[u8], width: usize, height: usize, color: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    let written = PngEncoder::new(&mut file).write_image(bytes, width as u32, height as u32, color);
    // Writing to memory fails for wrong dimensions only.
    debug_assert!(written.is_ok());
    file
}

// Encoding of JPEG files.

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

// Small copies of pictures, for lists.

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
