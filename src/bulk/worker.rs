//! Who does the work on an asset.

use std::path::Path;
use std::time::Duration;

use unwrapd_api::Failure;
use unwrapd_files::document::Upload;

/// What is written beside an output if it is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// The report as JSON.
    Report,
    /// A picture of the UV layout.
    Layout,
    /// A heat map of the distortion.
    Heatmap,
}

impl Extra {
    /// Where it is found among the files that a job made.
    pub(super) fn role(self) -> &'static str {
        match self {
            Self::Report => "report",
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
        }
    }

    /// What its name has in the place of the output's extension.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::Report => "report.json",
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
        }
    }
}

/// One asset to work on.
pub struct Task<'a> {
    /// Its files.
    pub upload: &'a Upload,
    /// Digest of the files, the options and the version.
    pub digest: &'a str,
    /// How often it was worked on before without success, the digest being the same.
    pub attempt: u32,
    /// An empty folder for what is made of it.
    pub folder: &'a Path,
}

/// Unwraps assets.
pub trait Worker: Send + Sync + 'static {
    /// Version of what unwraps: outputs of another one are made again.
    fn version(&self) -> &str;

    /// The time after which an asset ends with the map it has, if this worker sets it.
    fn time_limit(&self) -> Option<Duration>;

    /// Unwraps an asset, and gives the roles of the files that it made. The n-th is left in the
    /// task's folder as [`output_file`](unwrapd_api::output_file)`(n)`. Dropped before its end, it
    /// stops.
    fn work(&self, task: Task<'_>) -> impl Future<Output = Result<Vec<String>, Failure>> + Send;
}
