//! `unwrapd deform`: a mesh, a picture, a drawing or surfaces in a cage pulled by handles.

use std::path::PathBuf;

use super::failure::Failure;
use super::format::body_format;
use super::input::{read_file, read_upload};
use super::model::ModelArgs;
use super::output::stem;
use super::records::Records;
use crate::deform::parse_body_handles;
use crate::pipeline::{DeformOptions, Limits, deform_file};

/// Deforms a planar or tetrahedral mesh, or surfaces in a cage of tetrahedra, by handles, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh (.obj, .off, .msh, .mesh, .tet; planar also .glb, .gltf, .ply, .stl), or an outline to be meshed: PNG with
    /// transparency, SVG; with --cage surfaces: .glb, .gltf, .obj, .off, .ply, .stl; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// JSON: {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to": …}, {"center": …, "radius": r, "to": …}]}
    #[arg(long, value_name = "FILE")]
    handles: PathBuf,
    /// Where the deformed mesh goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu; of glTF, PLY and STL also
    /// .glb or .gltf, everything else in the file preserved; with --cage .glb, .gltf, .obj; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// About how many triangles an outline is filled with
    #[arg(long, default_value_t = 5000, value_name = "N")]
    triangles: usize,
    /// Put all meshes of the file, each once and without the transforms of nodes, into a cage of cubes, N along its longest side,
    /// and deform that. Handles are places ("at", "center"); connected parts of the cage without any stay at rest
    #[arg(long, value_name = "N")]
    cage: Option<u32>,
    /// With --cage: cut triangles where they pass from one of its tetrahedra into the next, so that they follow it exactly
    #[arg(long)]
    split: bool,
    #[command(flatten)]
    records: Records,
    #[command(flatten)]
    model: ModelArgs,
}

/// Runs `deform`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let mut options = DeformOptions {
        handles: Vec::new(),
        model: args.model.model(),
        triangles: args.triangles,
        cage: args.cage,
        split: args.split,
        barrier_continuation: records.course.barrier_continuation,
        bias: records.course.bias,
        frames: records.files.frames.is_some(),
        time_budget: records.time_budget,
        format: Some(format),
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check().map_err(Failure::of_options)?;
    let outputs = records.outputs(&args.output, &[&args.input, &args.handles])?;
    options.handles = parse_body_handles(&read_file(&args.handles)?)?;
    let upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = records.display(format);
    let deformed = deform_file(&upload, &options, &display);
    display.finish()?;
    records.write(&outputs, &deformed?)
}
