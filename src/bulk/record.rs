//! What a run leaves about an asset for later runs.

use std::fs;
use std::io;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::asset::Asset;
use super::place::Place;
use super::regular::read_regular;
use super::row::{Row, Status};
use super::trouble::Trouble;

/// What became of an asset, and of what that holds. It is written after the files that it lists.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Digest of input, options and version.
    pub(super) digest: String,
    /// How often the work on that has failed before.
    #[serde(default)]
    pub(super) attempt: u32,
    /// Seconds that the work had, if they are known.
    #[serde(default)]
    pub(super) time_limit: Option<f64>,
    /// Path within the output folder, and size, of each file that was written.
    pub(super) files: Vec<(PathBuf, u64)>,
    /// What became of it.
    #[serde(flatten)]
    pub(super) row: Row,
}

/// Codes of the service that another run may not meet: they are not those of the input and its
/// options.
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

impl Record {
    /// The record of an asset, if there is one that can be read.
    pub(super) fn load(place: &Place, asset: &Asset) -> Option<Self> {
        let bytes = read_regular(&place.path(&Place::record(asset))).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// Writes it.
    pub(super) fn store(&self, place: &Place, asset: &Asset) -> io::Result<()> {
        place.write(&Place::record(asset), &serde_json::to_vec_pretty(self)?)
    }

    /// Whether all the files are there, as far as their sizes tell.
    pub(super) fn is_whole(&self, place: &Place) -> bool {
        let is_there = |(path, bytes): &(PathBuf, u64)| {
            fs::metadata(place.path(path)).is_ok_and(|of| of.len() == *bytes)
        };
        self.files.iter().all(is_there)
    }

    /// Whether doing it again may end otherwise.
    pub(super) fn may_pass(&self) -> bool {
        match &self.row.status {
            Status::Failed { code, .. } => {
                PASSING.contains(&code.as_str()) || Trouble::of(code).is_some()
            }
            Status::Written(_) | Status::Missing => false,
        }
    }

    /// Whether it ended before it was done, and may get further in more time than it had.
    pub(super) fn was_cut_short(&self, time_limit: Option<f64>) -> bool {
        let has_more = self
            .time_limit
            .zip(time_limit)
            .is_some_and(|(had, has)| had < has);
        matches!(&self.row.status, Status::Written(figures) if figures.ended_early) && has_more
    }

    /// The number of the next attempt. What failed before or after the work itself is not one more.
    pub(super) fn next_attempt(&self) -> u32 {
        match &self.row.status {
            Status::Failed { code, .. } if is_of_work(code) => self.attempt + 1,
            _ => self.attempt,
        }
    }

    /// Whether it ended without an output.
    pub(super) fn has_failed(&self) -> bool {
        !matches!(self.row.status, Status::Written(_))
    }
}

/// Whether the work itself has failed, so that it is over.
fn is_of_work(code: &str) -> bool {
    code != "storage_full" && Trouble::of(code).is_none_or(|it| it == Trouble::Cancelled)
}
