//! `unwrapd solve`: a problem file of handles and targets.

use std::path::PathBuf;

use super::failure::Failure;
use super::format::body_format;
use super::input::{read_file, upload};
use super::output::stem;
use super::records::Records;
use super::words::{METHODS, word};
use crate::deform::{Method, ProblemFile};
use crate::pipeline::{Limits, SolveOptions, solve_file};

/// Solves a problem file: handles pulled to targets, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem: JSON naming a mesh, handles, targets, an energy and a barrier; paths in it are relative to it; `-` is standard input
    problem: PathBuf,
    /// Where the map goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// How: projected Newton with advancing targets, or the paper's iteration
    #[arg(long, default_value = "projected", value_parser = word::<Method>(METHODS))]
    method: Method,
    #[command(flatten)]
    records: Records,
}

/// Runs `solve`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let options = SolveOptions {
        method: args.method,
        barrier_continuation: records.course.barrier_continuation,
        bias: records.course.bias,
        frames: records.files.frames.is_some(),
        time_budget: records.time_budget,
        format,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check().map_err(Failure::of_options)?;
    let outputs = records.outputs(&args.output, &[&args.problem])?;
    let bytes = read_file(&args.problem)?;
    let problem = ProblemFile::parse(&bytes)?;
    let references: Vec<String> = problem.references().collect();
    let upload = upload(&args.problem, bytes, references);
    let outputs = outputs.with_resources_of(&upload);
    let display = records.display(format);
    let solved = solve_file(&upload, &options, &display);
    display.finish()?;
    records.write(&outputs, &solved?)
}
