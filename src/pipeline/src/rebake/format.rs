//! File format of resampled textures.

use serde::{Deserialize, Serialize};

use super::MOST_SIDE;
use unwrapd_files::document::gltf::GltfDocument;
use unwrapd_files::document::{BakePlane, DocumentError};
use unwrapd_files::picture::Image;

/// The format of the files of resampled textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum ImageFormat {
    /// JPEG if all source images are JPEG, otherwise PNG.
    #[default]
    Source,
    /// PNG, lossless.
    Png,
    /// JPEG, or PNG if a texel is transparent.
    Jpeg,
}

// The longest side of a JPEG file is 65,535 pixels.
const _: () = assert!(MOST_SIDE <= u16::MAX as u32);

impl ImageFormat {
    /// Encodes the texture that `plane` produced.
    pub fn file(
        self,
        document: &GltfDocument,
        plane: &BakePlane,
        image: &Image,
    ) -> Result<Vec<u8>, DocumentError> {
        let is_jpeg = match self {
            Self::Source => is_all_jpeg(document, plane)?,
            Self::Png => false,
            Self::Jpeg => true,
        };
        let jpeg = if is_jpeg { image.jpeg() } else { None };
        Ok(jpeg.unwrap_or_else(|| image.png()))
    }
}

/// Returns whether all source images of a texture are JPEG files.
fn is_all_jpeg(document: &GltfDocument, plane: &BakePlane) -> Result<bool, DocumentError> {
    const MAGIC: [u8; 3] = [0xFF, 0xD8, 0xFF];
    for source in plane.sources.values() {
        if !document.image(source.image)?.starts_with(&MAGIC) {
            return Ok(false);
        }
    }
    Ok(true)
}
