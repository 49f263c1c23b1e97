//! `unwrapd repack`: UVs packed anew, as they are.

use super::console::{json, print_json};
use super::failure::Failure;
use super::format::output_format;
use super::input::{Mapped, read_upload};
use super::output::{Files, Outputs, Target, caller};
use super::progress::Display;
use super::unwrap::summarize;
use crate::document::OutputFormat;
use crate::pipeline::{CommandOptions, RepackOptions, repack_document};

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
    options: RepackOptions,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let (input, to) = (&args.mapped.input, &args.target.output);
    let options = RepackOptions {
        format: output_format(to, args.files.format)?,
        caller: caller(to),
        ..args.options.clone()
    };
    options.check()?;
    let (report, output) = (&args.files.report, &args.files.output);
    let outputs = Outputs::check(to, &[report], &[input], output)?;
    let upload = read_upload(input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = Display::new(&output.talk);
    let outcome = repack_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    outputs.write(&outcome.files, &[(report, &json(&outcome.report)?)])?;
    if output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome)
}
