//! Acceptance gates for exit status 0.

use unwrapd_maps::certificate::Overlap;
use unwrapd_pipeline::{Mirrored, Report};
use unwrapd_server::jobs::{Gate, Gates};

use super::failure::Failure;
use unwrapd_worker::quality_of;

/// The gates of a command.
#[derive(clap::Args)]
pub(super) struct Acceptance {
    /// Gates that the result must meet for exit status 0, as a list with commas
    ///
    /// Gates are certified, max_charts=N, max_distortion=E, max_stretch=S, max_seconds=T and
    /// written. Distortion and stretch are those of the worst atlas: the mean energy, and the 99th
    /// percentile.
    #[arg(
        long,
        value_name = "GATES",
        default_value = "certified",
        help_heading = "Files and messages"
    )]
    accept: Gates,
}

impl Acceptance {
    /// Returns a failure if a result that took this many seconds misses a gate, or was only partly done. The result
    /// is written in any case.
    pub(super) fn judge(&self, report: &Report, seconds: f64) -> Result<(), Failure> {
        let quality = quality_of(report);
        let missed: Vec<&Gate> = self.accept.missed(&quality, seconds).collect();
        if missed.is_empty() && report.partly_done {
            let message = "certified, but not all textures and colors were resampled (partly_done)";
            return Err(Failure::partly(message));
        }
        if missed.is_empty() {
            return Ok(());
        }
        if missed.contains(&&Gate::Certified) {
            let missing = report.proven.lacks(Overlap::Test, Mirrored::Refused);
            return Err(Failure::uncertified(format!(
                "not certified, but written: {} (not_certified)",
                missing.join(", ")
            )));
        }
        let missed: Vec<String> = missed.into_iter().map(ToString::to_string).collect();
        Err(Failure::uncertified(format!(
            "not accepted, but written: {} (not_accepted)",
            missed.join(", ")
        )))
    }
}
