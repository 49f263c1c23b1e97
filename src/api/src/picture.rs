//! Pictures of results, and the task of drawing one.

use serde::{Deserialize, Serialize};

use crate::OutputFile;

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
    pub picture: Picture,
    /// Names of the input files; empty if the result suffices.
    pub input: Vec<String>,
    /// Output files of the job.
    pub output: Vec<OutputFile>,
    /// Memory limit in bytes.
    pub memory: u64,
}
