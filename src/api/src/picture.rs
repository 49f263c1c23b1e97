//! Pictures of results, and the task of drawing one or of decoding a texture.

use crate::OutputFile;
use serde::{Deserialize, Serialize};

/// Name of the file with a [`Drawing`] in the folder of a child.
pub const DRAWING: &str = "drawing.json";
/// Name of the file with the picture.
pub const PICTURE: &str = "picture.png";

/// A picture that a result can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Picture {
    /// The UV layout.
    Layout,
    /// The distortion.
    Heatmap,
    /// A small copy of the layout, or of a result that is itself a picture.
    Thumbnail,
}

impl Picture {
    /// All pictures.
    pub const ALL: [Self; 3] = [Self::Layout, Self::Heatmap, Self::Thumbnail];

    /// Returns its role among the files of a job, which is also its file name.
    pub fn role(self) -> &'static str {
        match self {
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
            Self::Thumbnail => "thumbnail.png",
        }
    }
}

/// Task of a drawing child. Its files have the same names as those of an attempt.
#[derive(Serialize, Deserialize)]
pub struct Drawing {
    /// Picture to draw.
    pub subject: Subject,
    /// Memory limit in bytes.
    pub memory: u64,
}

/// Picture that a child draws.
#[derive(Serialize, Deserialize)]
pub enum Subject {
    /// A picture of a result.
    Result {
        /// The picture.
        picture: Picture,
        /// Names of the input files; empty if the result suffices.
        input: Vec<String>,
        /// Output files of the job.
        output: Vec<OutputFile>,
    },
    /// The texture that is file 0 of the input.
    Texture,
}

// The header of frames with maps under way, which the server numbers. `unwrapd-worker` defines the rest of the
// format.

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
