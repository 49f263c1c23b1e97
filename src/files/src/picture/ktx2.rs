//! KTX 2.0 files as glTF has them: one picture in Basis Universal, ETC1S or UASTC.

use basisu::{DecodeFlags, TargetFormat, Transcoder};

/// First bytes of a file.
const MAGIC: &[u8] = b"\xABKTX 20\xBB\r\n\x1A\n";
/// Sides of a block in texels.
const BLOCK: u64 = 4;
/// Bytes of a block of UASTC, before compression of the whole level.
const BLOCK_BYTES: u64 = 16;

/// Returns whether a file is KTX 2.0.
pub(super) fn is_ktx2(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Decodes the pixels of the finest level, which has this [`size`].
///
/// # Errors
/// The reason why they cannot be decoded.
pub(super) fn pixels(bytes: &[u8], [width, height]: [u32; 2]) -> Result<Vec<[u8; 4]>, String> {
    // The decoder allocates what the file claims, so compare the claim with the size of the picture.
    let n_blocks = u64::from(width).div_ceil(BLOCK) * u64::from(height).div_ceil(BLOCK);
    let claimed = bytes.get(96..104).and_then(|claimed| claimed.as_array());
    if claimed.is_none_or(|claimed| u64::from_le_bytes(*claimed) > n_blocks * BLOCK_BYTES) {
        return Err("the level of full size has a wrong length".to_owned());
    }
    let transcoder = Transcoder::new(bytes).map_err(|error| undecodable(&error))?;
    if transcoder.face_count() > 1 || transcoder.layer_count() > 1 {
        return Err("it has several faces or layers".to_owned());
    }
    let pixels = transcoder
        .transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE)
        .map_err(|error| undecodable(&error))?;
    Ok(pixels.as_chunks().0.to_vec())
}

/// Returns columns and rows; `None` if the header is cut off or has none.
pub(super) fn size(bytes: &[u8]) -> Option<[u32; 2]> {
    let number = |at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(*bytes.get(at..at + 4)?.as_array()?))
    };
    let size = [number(20)?, number(24)?];
    (!size.contains(&0)).then_some(size)
}

fn undecodable(error: &basisu::Error) -> String {
    format!("its Basis Universal data cannot be decoded ({error:?})")
}
