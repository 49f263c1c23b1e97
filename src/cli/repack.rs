//! `unwrapd repack`: packing of existing UVs.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Deserialize;

use super::acceptance::Acceptance;
use super::console::{json, print_json};
use super::failure::Failure;
use super::format::output_format;
use super::input::{Mapped, read_file, read_upload};
use super::output::{Files, Outputs, Target, caller};
use super::progress::Display;
use super::unwrap::summarize;
use unwrapd_api::options::help_of;
use unwrapd_files::document::OutputFormat;
use unwrapd_pipeline::{CommandOptions, Island, RepackOptions, repack_document};

/// The arguments of `repack`.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    target: Target,
    #[command(flatten)]
    files: Files<OutputFormat>,
    #[command(flatten)]
    acceptance: Acceptance,
    #[arg(
        long,
        value_name = "I.json",
        help_heading = "Atlas",
        help = help_of::<RepackOptions>("islands")
    )]
    islands: Option<PathBuf>,
    #[command(flatten)]
    options: RepackOptions,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // Check options and paths before the work.
    let (input, to) = (&args.mapped.input, &args.target.output);
    let mut options = RepackOptions {
        format: output_format(to, args.files.format)?,
        caller: caller(to),
        ..args.options.clone()
    };
    options.check()?;
    let (report, output) = (&args.files.report, &args.files.output);
    let islands = args.islands.as_deref();
    let inputs: Vec<&Path> = [input.as_path()].into_iter().chain(islands).collect();
    let outputs = Outputs::check(to, &[report], &inputs, output)?;
    if let Some(islands) = islands {
        options.islands = given_islands(islands)?;
        options.check()?;
    }
    // Read the input and pack.
    let began = Instant::now();
    let upload = read_upload(input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = Display::new(&output.talk);
    let outcome = repack_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    // Write the result, report, and judge it by the gates.
    let written = outputs.write(&outcome.files, &[(report, &json(&outcome.report)?)])?;
    if output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome);
    written.tell();
    let seconds = began.elapsed().as_secs_f64();
    args.acceptance.judge(&outcome.report, seconds)
}

/// Reads the islands in a file.
fn given_islands(path: &Path) -> Result<Vec<Island>, Failure> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        islands: Vec<Island>,
    }
    let file: Result<File, _> = serde_json::from_slice(&read_file(path)?);
    let file = file.map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
    Ok(file.islands)
}
