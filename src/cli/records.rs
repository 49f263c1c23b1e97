//! What commands that pull a body write: the map, the report, the trace, frames.

use std::path::{Path, PathBuf};

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::output::{OutputArgs, Outputs, check_folder};
use super::progress::Display;
use super::words::{BODY_FORMATS, word};
use crate::pipeline::{BodyFormat, Deformed};

/// Files beside the map, and what is done beside minimizing once.
#[derive(clap::Args)]
pub(super) struct Records {
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    pub(super) time_budget: Option<f64>,
    #[command(flatten)]
    pub(super) files: RecordFiles,
    #[command(flatten)]
    pub(super) course: Course,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct RecordFiles {
    /// Format of OUT where its name does not tell
    #[arg(long, value_parser = word::<BodyFormat>(BODY_FORMATS))]
    pub(super) format: Option<BodyFormat>,
    /// Write a JSON report: status, iterations, energies, residual, seconds
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write a line per iteration as CSV
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Folder for the map of every iteration, numbered, in the format of the result; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub(super) frames: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Course of the solver")]
pub(super) struct Course {
    /// Lower the barrier's strength while the energy without it falls
    #[arg(long)]
    pub(super) barrier_continuation: bool,
    /// Also minimize without a barrier and report that energy beside the solution's: the barrier's bias
    #[arg(long)]
    pub(super) bias: bool,
}

impl Records {
    /// Checks where everything goes.
    pub(super) fn outputs(&self, main: &Path, inputs: &[&Path]) -> Result<Outputs, Failure> {
        let RecordFiles { report, trace, .. } = &self.files;
        let outputs = Outputs::check(main, &[report, trace], inputs, &self.files.output)?;
        self.files.frames.as_deref().map_or(Ok(()), check_folder)?;
        Ok(outputs)
    }

    /// Shows progress, and writes frames of a format if they are wanted.
    pub(super) fn display(&self, format: BodyFormat) -> Display {
        let talk = &self.files.output.talk;
        match &self.files.frames {
            Some(folder) => {
                Display::with_frames(talk, folder.clone(), format.extension().to_owned())
            }
            None => Display::new(talk),
        }
    }

    /// Writes everything.
    pub(super) fn write(&self, outputs: &Outputs, deformed: &Deformed) -> Result<(), Failure> {
        let RecordFiles { report, trace, .. } = &self.files;
        let others = [
            (report, json(&deformed.report)?),
            (trace, deformed.trace.clone().into_bytes()),
        ];
        let others = others
            .each_ref()
            .map(|(path, bytes)| (*path, bytes.as_slice()));
        outputs.write(&deformed.files, &others)?;
        if self.files.output.talk.json {
            print_json(&deformed.report)?;
        }
        summarize(deformed);
        Ok(())
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
    let (summary, worth) = (report.summary, report.worth);
    say(format_args!(
        "{:?}: {} iterations, {} factorizations, energy {:.6e}, barrier {:.3e}, residual {:.1e}, {} inverted{}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        worth.energy,
        worth.barrier,
        worth.residual,
        worth.inverted,
        (report.crossings).map_or(String::new(), |n| format!(
            ", {n} crossings of the boundary"
        ))
    ));
}
