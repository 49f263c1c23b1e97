//! Pictures of results, and what a child is told to draw one.

use serde::{Deserialize, Serialize};

use crate::OutputFile;

/// The file of a [`Drawing`] in the folder of a child.
pub const DRAWING: &str = "drawing.json";
/// The file of what was drawn.
pub const PICTURE: &str = "picture.png";

/// A picture that can be had of a result.
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
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Layout, Self::Heatmap, Self::Thumbnail];

    /// Where it is found among the files of a job, and the name under which it is saved.
    pub fn role(self) -> &'static str {
        match self {
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
            Self::Thumbnail => "thumbnail.png",
        }
    }
}

/// What a child draws. The files that it needs lie under the names that those of an attempt have.
#[derive(Serialize, Deserialize)]
pub struct Drawing {
    /// Which picture.
    pub picture: Picture,
    /// Names of the input files; empty where the result says all.
    pub input: Vec<String>,
    /// Files of the job.
    pub output: Vec<OutputFile>,
    /// Bytes.
    pub memory: u64,
}
