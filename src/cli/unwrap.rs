//! `unwrapd unwrap`: a mesh file in, the same with certified UVs out.

use super::console::{json, print_json, say, warn, warn_of};
use super::failure::Failure;
use super::input::read_upload;
use super::progress::Display;
use super::unwrap_args::Args;
use crate::certificate::Overlap;
use crate::document::WriteNotes;
use crate::pipeline::{self, CommandOptions, Mirrored, Outcome};

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = args.options()?;
    options.check()?;
    let outputs = args.outputs()?;
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
    outputs.write(&outcome.files, &others)?;
    if files.output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome)
}

/// A line per texture that is not right any more, or could not be resampled.
fn warn_of_textures(written: &WriteNotes) {
    let of = |material: Option<usize>| {
        material.map_or("a primitive".into(), |m| format!("material {m}"))
    };
    for texture in &written.textures_affected {
        let (of, slot) = (of(texture.material), &texture.slot);
        warn_of(format_args!(
            "{slot} of {of} shows the old layout; see --rebake"
        ));
    }
    for kept in &written.textures_kept {
        let (of, slot, reason) = (of(kept.material), &kept.slot, &kept.reason);
        warn_of(format_args!("{slot} of {of} stays with its UVs: {reason}"));
    }
}

/// The atlases, the warnings, and what is certified; where something that was asked for is not proven, a failure after all is said.
pub(super) fn summarize(outcome: &Outcome) -> Result<(), Failure> {
    let report = &outcome.report;
    super::table::print(&report.groups);
    warn(&report.warnings);
    if let Some(written) = &report.written {
        warn_of_textures(written);
    }
    if report.certified {
        say(format_args!("certified: {}", report.proven));
        return Ok(());
    }
    let missing = report.proven.lacks(Overlap::Test, Mirrored::Refused);
    Err(Failure::uncertified(format!(
        "written, but not certified: {} (not_certified)",
        missing.join(", ")
    )))
}
