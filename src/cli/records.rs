//! What commands that pull a body write: the map, the report, the trace, frames.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::files::{json, say, warn, write_atomically, write_outputs};
use super::progress::Display;
use crate::pipeline::{BodyFormat, Deformed};

/// Files beside the map, and what is done beside minimizing once.
#[derive(clap::Args)]
pub(super) struct Records {
    /// Write a JSON report: status, iterations, energies, residual, seconds
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write a line per iteration as CSV
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Folder for the map of every iteration, numbered, in the format of the result
    #[arg(long, value_name = "DIR")]
    pub(super) frames: Option<PathBuf>,
    /// Lower the barrier's strength while the energy without it falls
    #[arg(long)]
    pub(super) barrier_continuation: bool,
    /// Also minimize without a barrier and report that energy beside the solution's: the barrier's bias
    #[arg(long)]
    pub(super) bias: bool,
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    pub(super) time_budget: Option<f64>,
}

impl Records {
    /// Shows progress, and writes frames if they are wanted.
    pub(super) fn display(&self, output: &Path) -> Display {
        let extension = output.extension().unwrap_or_default().to_string_lossy();
        match &self.frames {
            Some(folder) => Display::with_frames(folder.clone(), extension.into_owned()),
            None => Display::new(),
        }
    }

    /// Writes everything.
    pub(super) fn write(&self, output: &Path, deformed: &Deformed) -> Result<(), Failure> {
        write_outputs(output, &deformed.files)?;
        if let Some(path) = &self.report {
            write_atomically(path, &json(&deformed.report)?)?;
        }
        if let Some(path) = &self.trace {
            write_atomically(path, deformed.trace.as_bytes())?;
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
        (worth.crossings).map_or(String::new(), |n| format!(
            ", {n} crossings of the boundary"
        ))
    ));
}

/// The format of a body to write, by the extension of its name.
pub(super) fn body_format(path: &Path) -> Result<BodyFormat, Failure> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    BodyFormat::of_extension(&extension.to_string_lossy()).ok_or_else(|| {
        Failure::usage(format!(
            "{}: the result is .txt, .obj, .off, .msh, .mesh, .tet, .vtu, .glb or .gltf",
            path.display()
        ))
    })
}

/// The name of a file without its extension.
pub(super) fn stem(path: &Path) -> Option<String> {
    Some(path.file_stem()?.to_string_lossy().into_owned())
}
