//! The header of frames with maps under way, which the server numbers. `unwrapd-worker` has the rest of the format.

/// The file of the latest frame in the folder of an attempt.
pub const MAPS: &str = "maps";

/// Bytes before the maps of a frame.
const HEADER: usize = 16;
/// The first byte of a frame.
const FRAME: u8 = 3;
/// Where its number is.
const NUMBER: std::ops::Range<usize> = 8..HEADER;

/// The header of a frame that has no number yet.
pub fn frame_header() -> Vec<u8> {
    let mut bytes = vec![0; HEADER];
    bytes[0] = FRAME;
    bytes
}

/// Numbers a frame. Whether it is one.
pub fn number_frame(frame: &mut [u8], number: u64) -> bool {
    let is_frame = HEADER <= frame.len() && frame[0] == FRAME;
    if is_frame {
        frame[NUMBER].copy_from_slice(&number.to_le_bytes());
    }
    is_frame
}
