//! Output of commands that deform a body: the map, the report, the trace, frames.

use std::path::{Path, PathBuf};

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::output::{Files, Outputs, check_folder};
use super::progress::Display;
use unwrapd_pipeline::{BodyFormat, Deformed};

/// Files beside the map.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct Records {
    #[command(flatten)]
    pub(super) files: Files<BodyFormat>,
    /// Write a CSV file with one line per iteration
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Directory for the map of every iteration, as numbered files in the format of the result; created if missing
    #[arg(long, value_name = "DIR")]
    pub(super) frames: Option<PathBuf>,
}

impl Records {
    /// Checks all output paths.
    pub(super) fn outputs(&self, main: &Path, inputs: &[&Path]) -> Result<Outputs, Failure> {
        let Files { report, output, .. } = &self.files;
        let outputs = Outputs::check(main, &[report, &self.trace], inputs, output)?;
        self.frames.as_deref().map_or(Ok(()), check_folder)?;
        Ok(outputs)
    }

    /// Creates the progress display, which also writes frames of a format if requested.
    pub(super) fn display(&self, format: BodyFormat) -> Display {
        let talk = &self.files.output.talk;
        match &self.frames {
            Some(folder) => {
                Display::with_frames(talk, folder.clone(), format.extension().to_owned())
            }
            None => Display::new(talk),
        }
    }

    /// Writes everything. Fails if handles are not at their targets.
    pub(super) fn write(&self, outputs: &Outputs, deformed: &Deformed) -> Result<(), Failure> {
        let others = [
            (&self.files.report, json(&deformed.report)?),
            (&self.trace, deformed.trace.clone().into_bytes()),
        ];
        let others = others
            .each_ref()
            .map(|(path, bytes)| (*path, bytes.as_slice()));
        let written = outputs.write(&deformed.files, &others)?;
        if self.files.output.talk.json {
            print_json(&deformed.report)?;
        }
        summarize(deformed);
        written.tell();
        Failure::unless_complete(deformed.report.completion)
    }
}

fn summarize(Deformed { report, .. }: &Deformed) {
    warn(&report.warnings);
    if let Some(cage) = &report.cage {
        say(format_args!(
            "{} voxels, {} tetrahedra, {} triangles, {} surface vertices, crossings {} before, {} after",
            cage.voxels,
            cage.tets,
            cage.surface_triangles,
            cage.surface_vertices,
            cage.crossings_before.pairs,
            cage.crossings_after.pairs
        ));
    }
    let (summary, quality) = (report.summary, report.quality);
    say(format_args!(
        "{:?}: {} iterations, {} factorizations, energy {:.6e} {}, barrier {:.3e}, residual {:.1e}, {} inverted{}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        quality.energy,
        report.units,
        quality.barrier,
        quality.residual,
        quality.inverted,
        (report.crossings).map_or(String::new(), |n| format!(
            ", {n} crossings of the boundary"
        ))
    ));
}
