//! `unwrapd solve`: a problem file of handles and targets.

use std::path::PathBuf;

use super::failure::Failure;
use super::files::{read_file, read_upload_with};
use super::records::{Records, body_format, stem};
use super::words::{METHODS, word};
use crate::deform::{Method, ProblemFile};
use crate::pipeline::{Limits, SolveOptions, solve_file};

/// Solves a problem file: handles pulled to targets, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem: JSON naming a mesh, handles, targets, an energy and a barrier; paths in it are relative to it
    problem: PathBuf,
    /// Where the map goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// How: projected Newton with advancing targets, or the paper's iteration
    #[arg(long, default_value = "projected", value_parser = word::<Method>(METHODS))]
    method: Method,
    #[command(flatten)]
    records: Records,
}

/// Runs `solve`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = SolveOptions {
        method: args.method,
        barrier_continuation: args.records.barrier_continuation,
        bias: args.records.bias,
        time_budget: args.records.time_budget,
        format: body_format(&args.output)?,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    let problem = ProblemFile::parse(&read_file(&args.problem)?)?;
    let upload = read_upload_with(&args.problem, problem.references())?;
    let display = args.records.display(&args.output);
    let solved = solve_file(&upload, &options, &display);
    display.finish()?;
    args.records.write(&args.output, &solved?)
}
