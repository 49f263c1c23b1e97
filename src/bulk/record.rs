//! Records of assets for later runs, and failures outside of the work itself.

use std::path::PathBuf;
use std::{fs, io};

use serde::{Deserialize, Serialize};

use super::assets::Asset;
use super::place::{OutputFolder, read_regular};
use super::rows::{AssetStatus, SummaryRow};
use unwrapd_api::Failure;

/// Outcome for an asset, and the digest that it holds for. It is written after the files that it lists.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AssetRecord {
    /// Digest of input, options and version.
    pub(super) digest: String,
    /// Number of earlier failures with this digest.
    #[serde(default)]
    pub(super) attempt: u32,
    /// Time limit of the work in seconds, if known.
    #[serde(default)]
    pub(super) time_limit: Option<f64>,
    /// Path within the output folder, and size in bytes, of each written file.
    pub(super) files: Vec<(PathBuf, u64)>,
    /// Outcome.
    #[serde(flatten)]
    pub(super) row: SummaryRow,
}

/// Codes of temporary failures: they are not about the input and its options, so another run may succeed.
const PASSING: [&str; 12] = [
    "conflict",
    "crashed",
    "damaged_file",
    "internal_error",
    "job_expired",
    "job_not_found",
    "missing_file",
    "no_such_file",
    "out_of_memory",
    "storage_full",
    "timed_out",
    "worker_lost",
];

impl AssetRecord {
    /// Loads the record of an asset; `None` if there is no readable one.
    pub(super) fn load(place: &OutputFolder, asset: &Asset) -> Option<Self> {
        let bytes = read_regular(&place.path(&OutputFolder::record(asset))).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// Writes the record.
    pub(super) fn store(&self, place: &OutputFolder, asset: &Asset) -> io::Result<()> {
        place.write(
            &OutputFolder::record(asset),
            &serde_json::to_vec_pretty(self)?,
        )
    }

    /// Returns whether all the files exist with the recorded sizes.
    pub(super) fn is_whole(&self, place: &OutputFolder) -> bool {
        self.files
            .iter()
            .all(|(path, bytes)| fs::metadata(place.path(path)).is_ok_and(|of| of.len() == *bytes))
    }

    /// Returns whether a retry may succeed because the failure was temporary.
    pub(super) fn may_pass(&self) -> bool {
        match &self.row.status {
            AssetStatus::Failed { code, .. } => {
                PASSING.contains(&code.as_str()) || Trouble::of(code).is_some()
            }
            AssetStatus::Written(_) | AssetStatus::Missing => false,
        }
    }

    /// Returns whether it ended early, and may get further with a longer time limit.
    pub(super) fn was_cut_short(&self, time_limit: Option<f64>) -> bool {
        let has_more = self
            .time_limit
            .zip(time_limit)
            .is_some_and(|(had, has)| had < has);
        matches!(&self.row.status, AssetStatus::Written(figures) if figures.ended_early) && has_more
    }

    /// Returns the number of the next attempt. Failures before or after the work itself do not count.
    pub(super) fn next_attempt(&self) -> u32 {
        match &self.row.status {
            AssetStatus::Failed { code, .. } if is_of_work(code) => self.attempt + 1,
            _ => self.attempt,
        }
    }

    /// Returns whether it ended without an output.
    pub(super) fn has_failed(&self) -> bool {
        !matches!(self.row.status, AssetStatus::Written(_))
    }
}

/// Returns whether a code means that the work itself failed.
fn is_of_work(code: &str) -> bool {
    code != "storage_full" && Trouble::of(code).is_none_or(|it| it == Trouble::Cancelled)
}

// Failures outside of the work itself. The other codes of a summary are those of the service.

/// Reason for a missing output although the work may have been done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// The job was cancelled.
    Cancelled,
    /// The input or a folder on its path cannot be read.
    InputUnreadable,
    /// A file to be written exists and belongs to another output.
    OutputConflict,
    /// A file cannot be written.
    OutputUnwritable,
    /// The service does not respond, or not properly.
    ServerUnavailable,
}

impl Trouble {
    /// Returns its code in summaries.
    pub fn word(self) -> &'static str {
        match self {
            Self::Cancelled => "cancelled",
            Self::InputUnreadable => "input_unreadable",
            Self::OutputConflict => "output_conflict",
            Self::OutputUnwritable => "output_unwritable",
            Self::ServerUnavailable => "server_unavailable",
        }
    }

    /// Returns the failure of an asset.
    pub fn with(self, detail: impl Into<String>) -> Failure {
        Failure::new(self.word(), detail)
    }

    /// Returns the variant with this code.
    pub fn of(code: &str) -> Option<Self> {
        let all = [
            Self::Cancelled,
            Self::InputUnreadable,
            Self::OutputConflict,
            Self::OutputUnwritable,
            Self::ServerUnavailable,
        ];
        all.into_iter().find(|trouble| trouble.word() == code)
    }
}

/// Returns the failure of a file that could not be written.
pub(super) fn unwritten(error: &io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            Failure::new("storage_full", error.to_string())
        }
        _ => Trouble::OutputUnwritable.with(error.to_string()),
    }
}
