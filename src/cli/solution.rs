//! What commands that solve a problem write: the map, the report, the trace.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use super::failure::Failure;
use super::files::{json, say, write_atomically};
use super::trace::{Frames, Trace};
use crate::deform::{Method, Problem, Solution, Worth};
use crate::mesh::io::{ElementFormat, Elements, text_positions};
use crate::pipeline::CageReport;
use crate::solver::{Control, Iterate, Settings, Summary};

/// Files beside the map.
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
    frames: Option<PathBuf>,
    /// Lower the barrier's strength while the energy without it falls
    #[arg(long)]
    barrier_continuation: bool,
    /// Also minimize without a barrier and report that energy beside the solution's: the barrier's bias
    #[arg(long)]
    bias: bool,
}

/// What `--report` holds.
#[derive(Serialize)]
struct Report {
    method: Method,
    #[serde(flatten)]
    summary: Summary,
    #[serde(flatten)]
    worth: Worth,
    /// The energy that minimizing without a barrier leads to from the solution, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_without_barrier: Option<f64>,
    /// The smallest size of an element over its rest size, over all iterates.
    smallest_ever: f64,
    /// Reading and checking.
    setup_seconds: f64,
    /// Everything after that.
    solve_seconds: f64,
    /// The cage and the surfaces in it, if that is what was deformed.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    cage: Option<CageReport>,
}

/// Solves the problem of a mesh and writes everything.
pub(super) fn solve_and_write(
    problem: &Problem,
    mesh: &Elements,
    method: Method,
    setup_seconds: f64,
    (output, path): (&Output, &Path),
    records: &Records,
) -> Result<(), Failure> {
    let frame = |x: &[f64]| output.text(mesh, problem, x);
    let frames = records.frames.as_deref().map(|folder| Frames {
        folder,
        extension: path
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        text: &frame,
    });
    let solved = solve(problem, method, setup_seconds, records, frames)?;
    write_atomically(path, frame(&solved.solution.x).as_bytes())?;
    solved.finish(records, None)
}

/// A solution, and what will be recorded of it.
pub(super) struct Solved<'a> {
    pub(super) solution: Solution,
    report: Report,
    trace: Trace<'a>,
    forbids_inversion: bool,
}

/// Solves a problem.
pub(super) fn solve<'a>(
    problem: &Problem,
    method: Method,
    setup_seconds: f64,
    records: &Records,
    frames: Option<Frames<'a>>,
) -> Result<Solved<'a>, Failure> {
    let trace = Trace::new(frames);
    let clock = Instant::now();
    let mut solution = trace.solve(problem, method)?;
    let settings = Settings::follow();
    let go_on = |_: &Iterate| Control::Continue;
    if records.barrier_continuation {
        solution = problem.with_weaker_barrier(solution, &settings, &go_on)?;
    }
    let energy_without_barrier = if records.bias {
        Some(problem.energy_without_barrier(&solution, &settings, &go_on)?)
    } else {
        None
    };
    let report = Report {
        method,
        summary: solution.summary,
        worth: solution.worth,
        energy_without_barrier,
        smallest_ever: trace.smallest().min(solution.worth.smallest),
        setup_seconds,
        solve_seconds: clock.elapsed().as_secs_f64(),
        cage: None,
    };
    Ok(Solved {
        solution,
        report,
        trace,
        forbids_inversion: problem.forbids_inversion(),
    })
}

impl Solved<'_> {
    /// Writes the records, with what became of the surfaces in a cage; exit 4 if the result has an inverted element that a
    /// barrier should have kept out.
    pub(super) fn finish(
        mut self,
        records: &Records,
        cage: Option<CageReport>,
    ) -> Result<(), Failure> {
        self.report.cage = cage;
        if let Some(path) = &records.report {
            write_atomically(path, &json(&self.report)?)?;
        }
        if let Some(path) = &records.trace {
            write_atomically(path, self.trace.csv().as_bytes())?;
        }
        let (summary, worth) = (self.report.summary, self.report.worth);
        say(format_args!(
            "{:?}: {} iterations, {} factorizations, energy {:.6e}, barrier {:.3e}, residual {:.1e}, {} inverted",
            summary.status,
            summary.iterations,
            summary.factorizations,
            worth.energy,
            worth.barrier,
            worth.residual,
            worth.inverted
        ));
        if worth.inverted > 0 && self.forbids_inversion {
            return Err(Failure::uncertified("no map without inversion"));
        }
        Ok(())
    }
}

/// The format of the result.
pub(super) enum Output {
    Positions,
    Mesh(ElementFormat),
}

impl Output {
    /// By the extension of the name.
    pub(super) fn of(path: &Path) -> Result<Self, Failure> {
        let name = path.to_string_lossy();
        if name.to_ascii_lowercase().ends_with(".txt") {
            return Ok(Self::Positions);
        }
        let format = ElementFormat::of_name(&name);
        format.map(Self::Mesh).ok_or_else(|| {
            Failure::usage(format!(
                "{name}: the result is .txt, .obj, .off, .msh, .mesh, .tet or .vtu"
            ))
        })
    }

    fn text(&self, mesh: &Elements, problem: &Problem, x: &[f64]) -> String {
        let is_planar = problem.body.dim() == 2;
        match self {
            Self::Positions if is_planar => text_positions::<2>(x.as_chunks().0),
            Self::Positions => text_positions::<3>(x.as_chunks().0),
            Self::Mesh(format) => {
                let vertices = if is_planar {
                    let planar: &[[f64; 2]] = x.as_chunks().0;
                    planar.iter().map(|p| [p[0], p[1], 0.0]).collect()
                } else {
                    x.as_chunks().0.to_vec()
                };
                format.write(&Elements {
                    vertices,
                    ..mesh.clone()
                })
            }
        }
    }
}
