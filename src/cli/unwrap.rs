//! `unwrapd unwrap`: a mesh file in, the same with certified UVs out.

use std::time::Instant;

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::input::read_upload;
use super::progress::Display;
use super::unwrap_args::Args;
use crate::pipeline::{self, CommandOptions, Outcome};

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = args.options()?;
    options.check()?;
    let outputs = args.outputs()?;
    let began = Instant::now();
    let upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    let files = &args.files;
    let display = Display::new(&files.output.talk);
    let outcome = pipeline::unwrap_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    let report = json(&outcome.report)?;
    let mut others = vec![(&files.report, report.as_slice())];
    let pictures = &args.pictures;
    let drawn = if pictures.layout.is_some() || pictures.heatmap.is_some() {
        Some(outcome.pictures.draw()?)
    } else {
        None
    };
    if let Some(drawn) = &drawn {
        others.push((&pictures.layout, &drawn.layout_png));
        others.push((&pictures.heatmap, &drawn.heatmap_png));
    }
    let written = outputs.write(&outcome.files, &others)?;
    if files.output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome);
    written.tell();
    let seconds = began.elapsed().as_secs_f64();
    args.acceptance.judge(&outcome.report, seconds)
}

/// The atlases, the warnings, and what is certified.
pub(super) fn summarize(outcome: &Outcome) {
    let report = &outcome.report;
    super::table::print(&report.groups);
    warn(&report.warnings);
    if report.certified {
        say(format_args!("certified: {}", report.proven));
    }
}
