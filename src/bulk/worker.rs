//! Interface of the workers that process assets, and the one that computes on this machine.

use std::path::Path;
use std::time::Duration;

use unwrapd_api::{Failure, Kind};
use unwrapd_files::document::Upload;
use unwrapd_server::jobs::Contained;

/// File that can be written beside an output.
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
    /// Returns its role among the files of a job.
    pub(super) fn role(self) -> &'static str {
        match self {
            Self::Report => "report",
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
        }
    }

    /// Returns the suffix that replaces the output's extension in its name.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::Report => "report.json",
            Self::Layout => "layout.png",
            Self::Heatmap => "heatmap.png",
        }
    }
}

/// An asset to process.
pub struct AssetTask<'a> {
    /// Its files.
    pub upload: &'a Upload,
    /// Digest of the files, the options and the version.
    pub digest: &'a str,
    /// Number of earlier failures with the same digest.
    pub attempt: u32,
    /// Empty folder for the results.
    pub folder: &'a Path,
}

/// Unwraps assets.
pub trait Worker: Send + Sync + 'static {
    /// Returns the version of the unwrapping program: outputs of other versions are made again.
    fn version(&self) -> &str;

    /// Returns the time after which an asset ends with its current map, if this worker sets it.
    fn time_limit(&self) -> Option<Duration>;

    /// Unwraps an asset, and returns the roles of its output files. Leaves the n-th one in the task's folder as
    /// [`output_file`](unwrapd_api::output_file)`(n)`. Dropping the future stops the work.
    fn work(
        &self,
        task: AssetTask<'_>,
    ) -> impl Future<Output = Result<Vec<String>, Failure>> + Send;
}

// Worker that computes in child processes on this machine.

/// Unwraps each asset in a child process.
#[derive(Clone, Debug)]
pub struct LocalWorker {
    /// Settings of the child processes.
    pub contained: Contained,
    /// Options of unwrapping.
    pub options: serde_json::Value,
}

impl Worker for LocalWorker {
    fn version(&self) -> &'static str {
        env!("CARGO_PKG_VERSION")
    }

    fn time_limit(&self) -> Option<Duration> {
        Some(self.contained.time)
    }

    async fn work(&self, task: AssetTask<'_>) -> Result<Vec<String>, Failure> {
        let (kind, options) = (Kind::Unwrap, &self.options);
        let made = (self.contained).run(kind, options, task.upload, task.folder);
        Ok(made.await?.into_iter().map(|file| file.role).collect())
    }
}
