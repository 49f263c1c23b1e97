//! `unwrapd repack`: UVs packed anew, as they are.

use std::path::PathBuf;

use super::failure::Failure;
use super::files::{json, output_format, read_upload, write_atomically, write_outputs};
use super::progress::Display;
use super::records::stem;
use super::unwrap::summarize;
use super::words::{GROUPS, word};
use crate::certificate::Resolution;
use crate::document::GroupBy;
use crate::pipeline::{Limits, RepackOptions, repack_document};

/// Packs the UV islands of all meshes into one atlas; each stays as it is but for quarter turns, shifts and one scale.
///
/// What is wrong with an island stays wrong. Where a triangle is flipped, without area or overlapping another, a chart is mirrored, or
/// the padding is not kept, OUT is written, a line says what is missing, and the exit status is 4: not certified.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh with UVs: .glb, .gltf or .obj
    input: PathBuf,
    /// Where to write; .glb, .gltf or .obj decides the format
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// UV set whose islands are packed [default: 0]
    #[arg(long, value_name = "N")]
    source_texcoord: Option<u32>,
    /// UV set to write [default: 0 where no texture samples it, else the next free one]
    #[arg(long, value_name = "N")]
    texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it
    #[arg(long)]
    overwrite: bool,
    /// What shares one atlas
    #[arg(long, default_value = "scene", value_parser = word::<GroupBy>(GROUPS))]
    group_by: GroupBy,
    /// Texels along the side of the texture, or along both: one is the other times a power of two
    #[arg(long, default_value = "1024", value_name = "N|WxH")]
    resolution: Resolution,
    /// Pages that islands may lie on, the tiles of UDIM from 1001 on
    #[arg(long, default_value_t = 1, value_name = "N")]
    pages: u32,
    /// Texels along one unit of length of the meshes, at the mean [default: as many as fit]
    #[arg(long, value_name = "T")]
    texels_per_unit: Option<f64>,
    /// Least distance of two islands in texels
    #[arg(long, default_value_t = 2, value_name = "TEXELS")]
    padding: u32,
    /// Threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Write the report as JSON
    #[arg(long, value_name = "R.json")]
    report: Option<PathBuf>,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = RepackOptions {
        source_texcoord: args.source_texcoord,
        texcoord: args.texcoord,
        overwrite: args.overwrite,
        group_by: args.group_by,
        resolution: args.resolution,
        pages: args.pages,
        texels_per_unit: args.texels_per_unit,
        padding: args.padding,
        threads: args.threads,
        format: output_format(&args.output)?,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check()?;
    let upload = read_upload(&args.input)?;
    let display = Display::new();
    let outcome = repack_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    write_outputs(&args.output, &outcome.files)?;
    if let Some(path) = &args.report {
        write_atomically(path, &json(&outcome.report)?)?;
    }
    summarize(&outcome)
}
