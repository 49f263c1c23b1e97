//! Errors of asset lists.

use std::path::PathBuf;

/// Reason why the list of assets is invalid.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// A folder or a manifest cannot be read.
    #[error("{}: {error}", path.display())]
    Unreadable {
        /// Path of the folder or manifest.
        path: PathBuf,
        /// Cause.
        error: std::io::Error,
    },
    /// There is nothing to do.
    #[error("{0} names no mesh: .glb, .gltf, .obj, .off, .ply or .stl")]
    NoAssets(String),
    /// A line of a manifest is invalid.
    #[error("{manifest}, line {number}: {cause}")]
    Line {
        /// Name of the manifest.
        manifest: String,
        /// Number of the line, from 1.
        number: usize,
        /// Cause.
        cause: String,
    },
    /// Two assets have the same output.
    #[error(
        "{first} and {second} would both be written to {}: name their outputs in a manifest",
        output.display()
    )]
    SameOutput {
        /// The first asset.
        first: String,
        /// The second asset.
        second: String,
        /// Their output, within the output folder.
        output: PathBuf,
    },
    /// An output would replace an input.
    #[error("{} is an input and would be replaced: choose another output directory", .0.display())]
    ReplacesInput(PathBuf),
}

impl ListError {
    /// Returns the exit status of the command line: 2 usage, 3 unusable input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unreadable { .. } | Self::NoAssets(_) | Self::Line { .. } => 3,
            Self::SameOutput { .. } | Self::ReplacesInput(_) => 2,
        }
    }
}
