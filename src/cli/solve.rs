//! `unwrapd solve`: problem files with handles and targets.

use std::path::PathBuf;

use super::failure::Failure;
use super::format::body_format;
use super::input::{read_file, upload};
use super::output::caller;
use super::records::Records;
use unwrapd_deform::ProblemFile;
use unwrapd_pipeline::{CommandOptions, SolveOptions, solve_file};

/// Solves a problem file: pulls handles to their targets. No element is inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem: JSON with a mesh, handles, targets, an energy and a barrier. Paths are relative to
    /// this file. `-` is standard input
    problem: PathBuf,
    /// Output map: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu; `-` is
    /// standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    records: Records,
    #[command(flatten)]
    options: SolveOptions,
}

/// Runs `solve`; exits with 5 if targets cannot be reached.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let options = SolveOptions {
        frames: records.frames.is_some(),
        format,
        caller: caller(&args.output),
        ..args.options.clone()
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
