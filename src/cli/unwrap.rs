//! `unwrapd unwrap`: a mesh file in, the same with certified UVs out.

use super::console::{json, print_json, say, warn, warn_of};
use super::failure::Failure;
use super::input::read_upload;
use super::progress::Display;
use super::unwrap_args::Args;
use crate::document::WriteNotes;
use crate::pipeline::{self, BoundReport, GroupReport, Outcome};

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
    let drawn = if files.layout.is_some() || files.heatmap.is_some() {
        Some(outcome.pictures.draw()?)
    } else {
        None
    };
    if let Some(drawn) = &drawn {
        others.push((&files.layout, &drawn.layout_png));
        others.push((&files.heatmap, &drawn.heatmap_png));
    }
    outputs.write(&outcome.files, &others)?;
    if files.output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome);
    Ok(())
}

/// A line where the atlas is more distorted than was asked for.
fn warn_of_bound(group: &GroupReport) {
    let bound = group.atlas.as_ref().and_then(|atlas| atlas.bound);
    if let Some(BoundReport { kept: false, .. }) = bound {
        let name = &group.name;
        warn_of(format_args!("{name} is more distorted than was asked for"));
    }
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

/// A line per atlas, and what is certified.
pub(super) fn summarize(outcome: &Outcome) {
    for group in &outcome.report.groups {
        super::measure::print_group(group);
        warn_of_bound(group);
    }
    warn(&outcome.report.warnings);
    if let Some(written) = &outcome.report.written {
        warn_of_textures(written);
    }
    let certified = if outcome.report.certified {
        "certified"
    } else {
        "not certified"
    };
    say(format_args!("{certified}: {}", outcome.report.proven));
}
