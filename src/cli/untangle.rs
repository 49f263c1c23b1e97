//! `unwrapd untangle`: meshes without inverted elements from folded ones.

use std::path::{Path, PathBuf};

use super::console::{CommandFailure, json, print_json, say, warn};
use super::files::{OutputFiles, Outputs, body_format, caller, read_upload};
use super::progress::Display;
use unwrapd_pipeline::{BodyFormat, CommandOptions, UntangleOptions, untangle_file};

/// Untangles a folded mesh of triangles in the plane or of tetrahedra: moves as few vertices as
/// possible until no element is inverted or empty.
#[derive(clap::Args)]
pub(super) struct UntangleArgs {
    /// Mesh: .obj, .off, .msh, .mesh or .tet. `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Mesh that gives the rest shapes: the same vertices and elements, without inversions
    #[arg(long, value_name = "FILE", conflicts_with = "rest")]
    rest_mesh: Option<PathBuf>,
    /// Output file: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu. `-` is
    /// standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    files: OutputFiles<BodyFormat>,
    #[command(flatten)]
    options: UntangleOptions,
}

/// Runs `untangle`; exits with 3 if no map without inversions is found, and with 6 if time runs out before.
pub(super) fn run(args: &UntangleArgs) -> Result<(), CommandFailure> {
    // Check options and paths before the work.
    let options = UntangleOptions {
        format: Some(body_format(&args.output, args.files.format)?),
        caller: caller(&args.output),
        ..args.options.clone()
    };
    options.check().map_err(CommandFailure::of_options)?;
    let inputs = std::iter::once(&args.input).chain(&args.rest_mesh);
    let inputs: Vec<&Path> = inputs.map(PathBuf::as_path).collect();
    let report = &args.files.report;
    let outputs = Outputs::check(&args.output, &[report], &inputs, &args.files.output)?;
    // Read the meshes and untangle.
    let upload = read_upload(&args.input)?;
    let rest = args.rest_mesh.as_deref().map(read_upload).transpose()?;
    let display = Display::new(&args.files.output.talk);
    let untangled = untangle_file(&upload, rest.as_ref(), &options, &display);
    display.finish()?;
    let untangled = untangled?;
    // Write the result, and report.
    let written = outputs.write(&untangled.files, &[(report, &json(&untangled.report)?)])?;
    if args.files.output.talk.json {
        print_json(&untangled.report)?;
    }
    warn(&untangled.report.warnings);
    say(format_args!(
        "{} of {} elements were inverted; {} vertices moved; the smallest element has {:.3e} of its size at rest",
        untangled.report.inverted_before,
        untangled.report.elements,
        untangled.report.moved,
        untangled.report.smallest
    ));
    written.tell();
    Ok(())
}
