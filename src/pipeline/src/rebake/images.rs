//! Source images of textures.

use std::collections::BTreeMap;

use unwrapd_files::document::gltf::GltfDocument;
use unwrapd_files::document::{BakePlane, DocumentError};
use unwrapd_files::picture::Image;

/// Maximum number of pixels of all images together: a gigabyte at four bytes each.
const MOST_PIXELS: usize = 1 << 28;

/// Images by index.
pub(super) type Images = BTreeMap<usize, Image>;

/// Decodes the images that are sampled. Returns them, and the reasons why others cannot be read.
pub(super) fn read_images(
    document: &GltfDocument,
    planes: &[BakePlane],
) -> Result<(Images, BTreeMap<usize, String>), DocumentError> {
    // List the images that are sampled, each once.
    let sources = planes.iter().flat_map(|plane| plane.sources.values());
    let mut indices: Vec<usize> = sources.map(|source| source.image).collect();
    indices.sort_unstable();
    indices.dedup();
    let (mut images, mut unreadable) = (Images::new(), BTreeMap::new());
    let mut pixels = 0;
    // Decode them; stop once they have too many pixels together.
    for index in indices {
        let decoded = match document.image(index) {
            Ok(bytes) => Image::decode(&bytes).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        match decoded {
            Ok(image) => {
                pixels += image.pixels.len();
                images.insert(index, image);
            }
            Err(reason) => drop(unreadable.insert(index, reason)),
        }
        if pixels > MOST_PIXELS {
            let most = MOST_PIXELS >> 20;
            return Err(DocumentError::LimitExceeded(format!(
                "the images have more than {most} Mi pixels"
            )));
        }
    }
    Ok((images, unreadable))
}
