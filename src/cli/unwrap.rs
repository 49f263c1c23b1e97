//! `unwrapd unwrap`: a mesh file in, the file with certified UVs out.

use std::path::PathBuf;
use std::time::Instant;

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::input::read_upload;
use super::progress::Display;
use super::unwrap_args::Args;
use unwrapd_pipeline::{self as pipeline, AtlasPicture, CommandOptions, Outcome};

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // Check options and paths before the work.
    let options = args.options()?;
    options.check()?;
    let outputs = args.outputs()?;
    // Read the input and unwrap.
    let began = Instant::now();
    let upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    let files = &args.files;
    let display = Display::new(&files.output.talk);
    let outcome = pipeline::unwrap_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    // Draw the requested pictures.
    let report = json(&outcome.report)?;
    let mut others = vec![(&files.report, report.as_slice())];
    let pictures = &args.pictures;
    let layout = drawn(&outcome, AtlasPicture::Layout, pictures.layout.as_ref())?;
    let heatmap = drawn(&outcome, AtlasPicture::Heatmap, pictures.heatmap.as_ref())?;
    others.extend(layout.iter().map(|png| (&pictures.layout, png.as_slice())));
    others.extend(
        heatmap
            .iter()
            .map(|png| (&pictures.heatmap, png.as_slice())),
    );
    // Write the result, report, and judge it by the gates.
    let written = outputs.write(&outcome.files, &others)?;
    if files.output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome);
    written.tell();
    let seconds = began.elapsed().as_secs_f64();
    args.acceptance.judge(&outcome.report, seconds)
}

/// Draws a picture if there is a path for it.
fn drawn(
    outcome: &Outcome,
    picture: AtlasPicture,
    path: Option<&PathBuf>,
) -> Result<Option<Vec<u8>>, Failure> {
    let drawn = path.map(|_| outcome.pictures.draw(picture));
    Ok(drawn.transpose()?)
}

/// Prints the atlases, the warnings, and the certified properties.
pub(super) fn summarize(outcome: &Outcome) {
    let report = &outcome.report;
    super::table::print(&report.groups);
    warn(&report.warnings);
    if report.certified {
        say(format_args!("certified: {}", report.proven));
    }
}
