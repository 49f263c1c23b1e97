//! The header of frames with maps under way, which the server numbers. `unwrapd-worker` defines the rest of the
//! format.

/// Name of the file with the latest frame in the folder of an attempt.
pub const MAPS: &str = "maps";

/// Length of the header of a frame in bytes: kind, padding and number, aligned to eight bytes.
const HEADER: usize = 16;
/// First byte of a frame. Meshes and frames of live sessions begin with 1 and 2.
const FRAME: u8 = 3;
/// Byte range of the frame's number.
const NUMBER: std::ops::Range<usize> = 8..HEADER;

/// Returns the header of a frame without a number.
pub fn frame_header() -> Vec<u8> {
    let mut bytes = vec![0; HEADER];
    bytes[0] = FRAME;
    bytes
}

/// Sets the number of a frame. Returns `false` if the bytes are not a frame.
pub fn number_frame(frame: &mut [u8], number: u64) -> bool {
    let is_frame = HEADER <= frame.len() && frame[0] == FRAME;
    if is_frame {
        frame[NUMBER].copy_from_slice(&number.to_le_bytes());
    }
    is_frame
}
