//! `unwrapd repack`: UVs packed anew, as they are.

use std::path::PathBuf;

use super::console::{json, print_json};
use super::failure::Failure;
use super::format::output_format;
use super::input::read_upload;
use super::output::{OutputArgs, Outputs, stem};
use super::progress::Display;
use super::unwrap::summarize;
use super::words::{FORMATS, GROUPS, word};
use crate::document::{GroupBy, OutputFormat};
use crate::mesh::Resolution;
use crate::pipeline::{Limits, RepackOptions, repack_document};

/// Packs the UV islands of all meshes into one atlas; each stays as it is but for quarter turns, shifts and one scale.
///
/// What is wrong with an island stays wrong. Where a triangle is flipped, without area or overlapping another, a chart is mirrored, or
/// the padding is not kept, OUT is written, a line says what is missing, and the exit status is 4: not certified.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Where to write: .glb, .gltf or .obj decides the format; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// What shares one atlas
    #[arg(long, default_value = "scene", value_parser = word::<GroupBy>(GROUPS))]
    group_by: GroupBy,
    /// Texels along the side of the texture, or along both: one is the other times a power of two
    #[arg(long, default_value = "1024", value_name = "N|WxH")]
    resolution: Resolution,
    /// Least distance of two islands in texels
    #[arg(long, default_value_t = 2, value_name = "TEXELS")]
    padding: u32,
    /// Pages that islands may lie on, the tiles of UDIM from 1001 on
    #[arg(long, default_value_t = 1, value_name = "N")]
    pages: u32,
    /// Texels along one unit of length of the meshes, at the mean [default: as many as fit]
    #[arg(long, value_name = "T")]
    texels_per_unit: Option<f64>,
    /// Threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    sets: Sets,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
struct Files {
    /// Format of OUT where its name does not tell
    #[arg(long, value_parser = word::<OutputFormat>(FORMATS))]
    format: Option<OutputFormat>,
    /// Write the report as JSON
    #[arg(long, value_name = "R.json")]
    report: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(clap::Args)]
#[command(next_help_heading = "UV sets")]
struct Sets {
    /// UV set whose islands are packed [default: 0]
    #[arg(long, value_name = "N")]
    source_texcoord: Option<u32>,
    /// UV set to write [default: 0 where no texture samples it, else the next free one]
    #[arg(long, value_name = "N")]
    texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it
    #[arg(long)]
    overwrite: bool,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = RepackOptions {
        source_texcoord: args.sets.source_texcoord,
        texcoord: args.sets.texcoord,
        overwrite: args.sets.overwrite,
        group_by: args.group_by,
        resolution: args.resolution,
        pages: args.pages,
        texels_per_unit: args.texels_per_unit,
        padding: args.padding,
        threads: args.threads,
        format: output_format(&args.output, args.files.format)?,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check()?;
    let (report, output) = (&args.files.report, &args.files.output);
    let outputs = Outputs::check(&args.output, &[report], &[&args.input], output)?;
    let upload = read_upload(&args.input)?;
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
