//! `unwrapd edit-uv` and `unwrapd texture-map`: UVs pulled by anchors.

use std::path::{Path, PathBuf};

use super::console::{json, print_json, warn};
use super::failure::Failure;
use super::format::output_format;
use super::input::{read_file, read_upload};
use super::model::ModelArgs;
use super::output::{OutputArgs, Outputs, stem};
use super::progress::Display;
use super::warp::print_pull;
use super::words::{BOUNDARIES, FORMATS, UV_RESTS, word};
use crate::deform::Boundary;
use crate::deform::uv::{UvRest, parse_anchors};
use crate::document::OutputFormat;
use crate::pipeline::{EditOptions, Editing, Limits, edit_document};

/// Moves anchors of a UV map, everything else as it is as far as possible and no triangle flipped.
#[derive(clap::Args)]
pub(super) struct EditArgs {
    /// Anchors in the numbers of the file (glTF: v down): {"anchors": [{"vertex": i, "to": [u, v]}, {"at": [u, v], "to": …}, …]};
    /// `at` means the point of the surface that has this UV
    #[arg(long, value_name = "A.json")]
    anchors: PathBuf,
    #[command(flatten)]
    common: Common,
}

/// Aligns points of a surface with points of a texture: `edit-uv` with boundaries fixed and the surface's shapes kept.
#[derive(clap::Args)]
pub(super) struct TextureArgs {
    /// Points, as the anchors of `edit-uv`: {"points": [{"vertex": i, "to": [u, v]}, {"at": [u, v], "to": …}, …]}
    #[arg(long, value_name = "P.json")]
    points: PathBuf,
    #[command(flatten)]
    common: Common,
}

#[derive(clap::Args)]
struct Common {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Where to write: .glb, .gltf or .obj decides the format; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// UV set
    #[arg(long, default_value_t = 0, value_name = "N")]
    texcoord: u32,
    /// Whether the boundaries of charts stay [default: free for edit-uv, fixed for texture-map]
    #[arg(long, value_parser = word::<Boundary>(BOUNDARIES))]
    boundary: Option<Boundary>,
    /// Which shapes of triangles to keep [default: present for edit-uv, surface for texture-map]
    #[arg(long, value_parser = word::<UvRest>(UV_RESTS))]
    rest: Option<UvRest>,
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    time_budget: Option<f64>,
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    model: ModelArgs,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
struct Files {
    /// Format of OUT where its name does not tell
    #[arg(long, value_parser = word::<OutputFormat>(FORMATS))]
    format: Option<OutputFormat>,
    /// Write a JSON report: per chart status, iterations, energy, residual, what is proven
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs `edit-uv`.
pub(super) fn edit(args: &EditArgs) -> Result<(), Failure> {
    run(&args.common, &args.anchors, Editing::Map)
}

/// Runs `texture-map`.
pub(super) fn texture_map(args: &TextureArgs) -> Result<(), Failure> {
    run(&args.common, &args.points, Editing::Texture)
}

/// Exit 4 if a chart with an anchor is not proven to be without flips.
fn run(args: &Common, anchors: &Path, editing: Editing) -> Result<(), Failure> {
    let mut options = EditOptions {
        anchors: Vec::new(),
        texcoord: args.texcoord,
        boundary: args.boundary,
        rest: args.rest,
        model: args.model.model(),
        time_budget: args.time_budget,
        format: output_format(&args.output, args.files.format)?,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check().map_err(Failure::of_options)?;
    let (report, output) = (&args.files.report, &args.files.output);
    let outputs = Outputs::check(&args.output, &[report], &[&args.input, anchors], output)?;
    options.anchors = parse_anchors(&read_file(anchors)?)?;
    let upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = Display::new(&output.talk);
    let edited = edit_document(&upload, editing, &options, &display);
    display.finish()?;
    let edited = edited?;
    outputs.write(&edited.files, &[(report, &json(&edited.report)?)])?;
    if output.talk.json {
        print_json(&edited.report)?;
    }
    warn(&edited.report.warnings);
    for chart in &edited.report.charts {
        print_pull(&format!("chart {}: ", chart.chart), &chart.map);
    }
    warn(&edited.report.warnings);
    if edited.report.certified {
        Ok(())
    } else {
        Err(Failure::uncertified("a chart is not valid"))
    }
}
