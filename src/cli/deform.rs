//! `unwrapd deform`: deformation of a mesh, a picture, a drawing or surfaces in a cage by handles.

use std::path::PathBuf;

use super::failure::Failure;
use super::format::body_format;
use super::input::{read_file, read_upload};
use super::output::caller;
use super::records::Records;
use unwrapd_api::options::help_of;
use unwrapd_deform::parse_body_handles;
use unwrapd_pipeline::{CommandOptions, DeformOptions, deform_file};

/// Deforms a planar or tetrahedral mesh, or surfaces in a cage of tetrahedra, by handles. No
/// element is inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh: .obj, .off, .msh, .mesh or .tet; planar also .glb, .gltf, .ply or .stl. Outline to
    /// fill with triangles: PNG with transparency, or SVG. With --cage, surfaces: .glb, .gltf,
    /// .obj, .off, .ply or .stl. `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    #[arg(long, value_name = "FILE", help = help_of::<DeformOptions>("handles"))]
    handles: PathBuf,
    /// Output file: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu. For glTF,
    /// PLY and STL also .glb or .gltf, with everything else in the file preserved. With --cage:
    /// .glb, .gltf or .obj. `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    records: Records,
    #[command(flatten)]
    options: DeformOptions,
}

/// Runs `deform`; exits with 5 if targets cannot be reached.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let mut options = DeformOptions {
        frames: records.frames.is_some(),
        format: Some(format),
        caller: caller(&args.output),
        ..args.options.clone()
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
