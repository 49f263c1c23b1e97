//! `unwrapd edit-uv` and `unwrapd texture-map`: editing of UVs by anchors.

use std::path::{Path, PathBuf};

use super::console::{CommandFailure, json, print_json, warn};
use super::deform::print_pull;
use super::files::{
    Mapped, OutputFiles, OutputTarget, Outputs, caller, output_format, read_file, read_upload,
};
use super::progress::Display;
use unwrapd_api::options::help_of;
use unwrapd_deform::uv::parse_anchors;
use unwrapd_files::document::OutputFormat;
use unwrapd_pipeline::{CommandOptions, EditOptions, Editing, edit_document};

/// Moves anchors of a UV map. Everything else stays as close to its place as possible, and no
/// triangle is flipped.
#[derive(clap::Args)]
pub(super) struct EditArgs {
    #[arg(long, value_name = "A.json", help = help_of::<EditOptions>("anchors"))]
    anchors: PathBuf,
    #[command(flatten)]
    common: Common,
}

/// Aligns points of a surface with points of a texture. Like `edit-uv`, but with fixed boundaries,
/// and preserving the surface's shapes.
#[derive(clap::Args)]
pub(super) struct TextureArgs {
    /// Points, in the form of `edit-uv` anchors: {"points": [{"vertex": i, "to": [u, v]}, {"at":
    /// [u, v], "to": …}, …]}
    #[arg(long, value_name = "P.json")]
    points: PathBuf,
    #[command(flatten)]
    common: Common,
}

#[derive(clap::Args)]
struct Common {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    target: OutputTarget,
    #[command(flatten)]
    files: OutputFiles<OutputFormat>,
    #[command(flatten)]
    options: EditOptions,
}

/// Runs `edit-uv`.
pub(super) fn edit(args: &EditArgs) -> Result<(), CommandFailure> {
    run(&args.common, &args.anchors, Editing::Map)
}

/// Runs `texture-map`.
pub(super) fn texture_map(args: &TextureArgs) -> Result<(), CommandFailure> {
    run(&args.common, &args.points, Editing::Texture)
}

/// Runs an edit; exits with 4 if the UV set is not proven to be bijective, with 5 if targets cannot be reached.
fn run(args: &Common, anchors: &Path, editing: Editing) -> Result<(), CommandFailure> {
    // Check options and paths before the work.
    let (input, to) = (&args.mapped.input, &args.target.output);
    let mut options = EditOptions {
        format: output_format(to, args.files.format)?,
        caller: caller(to),
        ..args.options.clone()
    };
    options.check().map_err(CommandFailure::of_options)?;
    let (report, output) = (&args.files.report, &args.files.output);
    let outputs = Outputs::check(to, &[report], &[input, anchors], output)?;
    // Read the inputs and edit.
    options.anchors = parse_anchors(&read_file(anchors)?)?;
    let upload = read_upload(input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = Display::new(&output.talk);
    let edited = edit_document(&upload, editing, &options, &display);
    display.finish()?;
    let edited = edited?;
    // Write the result, even one without a certificate, and report.
    let written = outputs.write(&edited.files, &[(report, &json(&edited.report)?)])?;
    if output.talk.json {
        print_json(&edited.report)?;
    }
    warn(&edited.report.warnings);
    for chart in &edited.report.charts {
        print_pull(&format!("chart {}: ", chart.chart), &chart.map);
    }
    written.tell();
    if !edited.report.certified {
        let lacking = edited.report.lacking.join(", ");
        return Err(CommandFailure::uncertified(format!(
            "not certified, but written: {lacking}"
        )));
    }
    CommandFailure::unless_complete(edited.report.completion)
}
