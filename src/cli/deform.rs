//! `unwrapd deform`: a mesh, a picture, a drawing or surfaces in a cage pulled by handles.

use std::path::PathBuf;

use super::failure::Failure;
use super::files::{read_file, read_upload};
use super::model::ModelArgs;
use super::records::{Records, body_format, stem};
use crate::deform::parse_body_handles;
use crate::pipeline::{DeformOptions, Limits, deform_file};

/// Deforms a planar or tetrahedral mesh, or surfaces in a cage of tetrahedra, by handles, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh (.obj, .off, .msh, .mesh, .tet; planar also .glb, .gltf, .ply, .stl), or an outline to be meshed: PNG with
    /// transparency, SVG; with --cage surfaces: .glb, .gltf, .obj, .off, .ply, .stl
    input: PathBuf,
    /// JSON: {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to": …}, {"center": …, "radius": r, "to": …}]}
    #[arg(long, value_name = "FILE")]
    handles: PathBuf,
    /// Where the deformed mesh goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu; of glTF, PLY and STL also
    /// .glb or .gltf, everything else in the file preserved; with --cage .glb, .gltf, .obj
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    model: ModelArgs,
    /// About how many triangles an outline is filled with
    #[arg(long, default_value_t = 5000, value_name = "N")]
    triangles: usize,
    /// Put all meshes of the file, each once and without the transforms of nodes, into a cage of cubes, N along its longest side,
    /// and deform that. Handles are places ("at", "center"); connected parts of the cage without any stay at rest
    #[arg(long, value_name = "N")]
    cage: Option<u32>,
    /// With --cage: cut triangles where they pass from one of its tetrahedra into the next, so that they follow it exactly
    #[arg(long, requires = "cage")]
    split: bool,
    #[command(flatten)]
    records: Records,
}

/// Runs `deform`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let mut options = DeformOptions {
        handles: Vec::new(),
        model: args.model.model(),
        triangles: args.triangles,
        cage: args.cage,
        split: args.split,
        barrier_continuation: args.records.barrier_continuation,
        bias: args.records.bias,
        frames: args.records.frames.is_some(),
        time_budget: args.records.time_budget,
        format: Some(body_format(&args.output)?),
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check()?;
    let display = args.records.display(&args.output);
    options.handles = parse_body_handles(&read_file(&args.handles)?)?;
    let upload = read_upload(&args.input)?;
    let deformed = deform_file(&upload, &options, &display);
    display.finish()?;
    args.records.write(&args.output, &deformed?)
}
