//! What commands that solve a problem write: the map, the report, the trace.

use std::cell::RefCell;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use super::failure::Failure;
use super::files::{json, write_atomically};
use crate::deform::{Method, Problem, Solution, Worth};
use crate::mesh::io::{ElementFormat, Elements, text_positions};
use crate::solver::{Control, Iterate, LevenbergStep, Settings, Summary};

/// Files beside the map.
#[derive(clap::Args)]
pub(super) struct Records {
    /// Write a JSON report: status, iterations, energies, residual, seconds
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write a line per iteration as CSV
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
}

/// What `--report` holds.
#[derive(Serialize)]
struct Report {
    method: Method,
    #[serde(flatten)]
    summary: Summary,
    #[serde(flatten)]
    worth: Worth,
    /// The smallest size of an element over its rest size, over all iterates.
    smallest_ever: f64,
    /// Reading and checking.
    setup_seconds: f64,
    /// Everything after that.
    solve_seconds: f64,
}

/// Solves a problem and writes everything; exit 4 if the result has an inverted element that a barrier should have kept out.
pub(super) fn solve_and_write(
    problem: &Problem,
    mesh: Elements,
    method: Method,
    setup_seconds: f64,
    (output, path): (&Output, &Path),
    records: &Records,
) -> Result<(), Failure> {
    let trace = Trace::default();
    let clock = Instant::now();
    let solution = trace.solve(problem, method)?;
    let report = Report {
        method,
        summary: solution.summary,
        worth: solution.worth,
        smallest_ever: trace.smallest().min(solution.worth.smallest),
        setup_seconds,
        solve_seconds: clock.elapsed().as_secs_f64(),
    };
    write_atomically(path, output.text(mesh, problem, &solution).as_bytes())?;
    if let Some(path) = &records.report {
        write_atomically(path, &json(&report)?)?;
    }
    if let Some(path) = &records.trace {
        write_atomically(path, trace.csv().as_bytes())?;
    }
    let (summary, worth) = (report.summary, report.worth);
    println!(
        "{:?}: {} iterations, {} factorizations, energy {:.6e}, barrier {:.3e}, residual {:.1e}, {} inverted",
        summary.status,
        summary.iterations,
        summary.factorizations,
        worth.energy,
        worth.barrier,
        worth.residual,
        worth.inverted
    );
    if worth.inverted > 0 && problem.forbids_inversion() {
        return Err(Failure::uncertified("no map without inversion"));
    }
    Ok(())
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

    fn text(&self, mesh: Elements, problem: &Problem, solution: &Solution) -> String {
        let is_planar = problem.body.dim() == 2;
        match self {
            Self::Positions if is_planar => text_positions::<2>(solution.x.as_chunks().0),
            Self::Positions => text_positions::<3>(solution.x.as_chunks().0),
            Self::Mesh(format) => {
                let vertices = if is_planar {
                    let planar: &[[f64; 2]] = solution.x.as_chunks().0;
                    planar.iter().map(|p| [p[0], p[1], 0.0]).collect()
                } else {
                    solution.x.as_chunks().0.to_vec()
                };
                format.write(&Elements { vertices, ..mesh })
            }
        }
    }
}

/// What happened in every iteration.
#[derive(Default)]
struct Trace {
    iterates: RefCell<Vec<Iterate>>,
    steps: RefCell<Vec<LevenbergStep>>,
}

impl Trace {
    fn solve(&self, problem: &Problem, method: Method) -> Result<Solution, Failure> {
        let watch = |iterate: &Iterate| {
            self.iterates.borrow_mut().push(*iterate);
            Control::Continue
        };
        let mut record = |step: &LevenbergStep| self.steps.borrow_mut().push(*step);
        Ok(match method {
            Method::Projected => problem.solve(&Settings::follow(), &watch)?,
            Method::Levenberg => {
                problem.solve_by_levenberg(&problem.levenberg, &watch, &mut record)?
            }
        })
    }

    fn smallest(&self) -> f64 {
        let sizes = self.iterates.borrow();
        sizes
            .iter()
            .map(|i| i.smallest)
            .fold(f64::INFINITY, f64::min)
    }

    fn csv(&self) -> String {
        let (iterates, steps) = (self.iterates.borrow(), self.steps.borrow());
        let mut text = String::from("iteration,energy,smallest,mu,sigma,alpha,residual\n");
        for (index, i) in iterates.iter().enumerate() {
            let step = steps.get(index).map_or(",,,".to_owned(), |step| {
                format!(
                    "{:e},{:e},{:e},{:e}",
                    step.mu, step.sigma, step.alpha, step.residual
                )
            });
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{},{:e},{:e},{step}",
                i.iteration, i.energy, i.smallest
            );
        }
        text
    }
}
