//! `unwrapd deform`, `unwrapd solve` and `unwrapd warp`: deformation of bodies and pictures by handles.

use std::path::{Path, PathBuf};

use super::console::{CommandFailure, json, print_json, say, warn};
use super::files::{
    OutputArgs, OutputFiles, Outputs, body_format, caller, check_folder, check_png, read_file,
    read_upload, upload,
};
use super::progress::Display;
use unwrapd_api::START;
use unwrapd_api::options::help_of;
use unwrapd_deform::warp::parse_handles;
use unwrapd_deform::{ProblemFile, Units, parse_body_handles};
use unwrapd_pipeline::{
    BodyFormat, CommandOptions, DeformOptions, Deformed, PullReport, SolveOptions, WarpOptions,
    deform_file, solve_file, start_file_of_text, warp_file,
};

/// Deforms a planar or tetrahedral mesh, or surfaces in a cage of tetrahedra, by handles. No
/// element is inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh: .obj, .off, .msh, .mesh or .tet; planar also .glb, .gltf, .ply or .stl. Outline to
    /// fill with triangles: PNG with transparency, or SVG. With --cage, surfaces: .glb, .gltf,
    /// .obj, .off, .ply or .stl. `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    #[arg(long, value_name = "FILE", required_unless_present = "start", help = help_of::<DeformOptions>("handles"))]
    handles: Option<PathBuf>,
    /// Positions to start from, one vertex per line, as an output .txt has them. Inverted elements
    /// are untangled. The energy is minimized from there; handles are optional then
    #[arg(long, value_name = "FILE", conflicts_with = "cage")]
    start: Option<PathBuf>,
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
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let mut options = DeformOptions {
        frames: records.frames.is_some(),
        format: Some(format),
        caller: caller(&args.output),
        ..args.options.clone()
    };
    options.check().map_err(CommandFailure::of_options)?;
    let further = [&args.handles, &args.start].into_iter().flatten();
    let inputs: Vec<&Path> = (std::iter::once(&args.input).chain(further))
        .map(PathBuf::as_path)
        .collect();
    let outputs = records.outputs(&args.output, &inputs)?;
    if let Some(handles) = &args.handles {
        options.handles = parse_body_handles(&read_file(handles)?)?;
    }
    let mut upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    if let Some(start) = &args.start {
        let start = start_file_of_text(&read_file(start)?)?;
        upload.resources.insert(START.to_owned(), start);
    }
    let display = records.display(format);
    let deformed = deform_file(&upload, &options, &display);
    display.finish()?;
    records.write(&outputs, &deformed?)
}

// `unwrapd solve`: problem files with handles and targets.

/// Solves a problem file: pulls handles to their targets. No element is inverted.
#[derive(clap::Args)]
pub(super) struct SolveArgs {
    /// Problem: JSON with a mesh, handles, targets, an energy and a barrier. Paths are relative to
    /// this file. `-` is standard input
    problem: PathBuf,
    /// Output map: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu; `-` is
    /// standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    records: Records,
    #[command(flatten)]
    options: SolveOptions,
}

/// Runs `solve`; exits with 5 if targets cannot be reached.
pub(super) fn solve(args: &SolveArgs) -> Result<(), CommandFailure> {
    let records = &args.records;
    let format = body_format(&args.output, records.files.format)?;
    let options = SolveOptions {
        frames: records.frames.is_some(),
        format,
        caller: caller(&args.output),
        ..args.options.clone()
    };
    options.check().map_err(CommandFailure::of_options)?;
    let outputs = records.outputs(&args.output, &[&args.problem])?;
    let bytes = read_file(&args.problem)?;
    let problem = ProblemFile::parse(&bytes)?;
    let references: Vec<String> = problem.references().collect();
    let upload = upload(&args.problem, bytes, references);
    let outputs = outputs.with_resources_of(&upload);
    let display = records.display(format);
    let solved = solve_file(&upload, &options, &display);
    display.finish()?;
    records.write(&outputs, &solved?)
}

// `unwrapd warp`: warping of a picture by handles.

/// Warps a picture by handles without folding it.
#[derive(clap::Args)]
pub(super) struct WarpArgs {
    /// Picture: .png, .jpg or .webp; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    #[arg(long, value_name = "H.json", help = help_of::<WarpOptions>("handles"))]
    handles: PathBuf,
    /// Output picture, as PNG; `-` is standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Write a report as JSON: status, iterations, energy, residual, proofs
    #[arg(long, value_name = "FILE", help_heading = "Files and messages")]
    report: Option<PathBuf>,
    #[command(flatten)]
    files: OutputArgs,
    #[command(flatten)]
    options: WarpOptions,
}

/// Runs `warp`; exits with 4 if the map has an inverted triangle, or is not bijective with a fixed border, and with 5
/// if targets cannot be reached.
pub(super) fn warp(args: &WarpArgs) -> Result<(), CommandFailure> {
    // Check options and paths before the work.
    let mut options = WarpOptions {
        caller: caller(&args.output),
        ..args.options.clone()
    };
    options.check().map_err(CommandFailure::of_options)?;
    check_png(&args.output)?;
    let (report, inputs) = (&args.report, [args.input.as_path(), &args.handles]);
    let outputs = Outputs::check(&args.output, &[report], &inputs, &args.files)?;
    // Read the inputs and warp.
    options.handles = parse_handles(&read_file(&args.handles)?)?;
    let upload = read_upload(&args.input)?;
    let display = Display::new(&args.files.talk);
    let warped = warp_file(&upload, &options, &display);
    display.finish()?;
    let warped = warped?;
    // Write the result, even one without a certificate, and report.
    let written = outputs.write(&warped.files, &[(report, &json(&warped.report)?)])?;
    if args.files.talk.json {
        print_json(&warped.report)?;
    }
    warn(&warped.report.warnings);
    print_pull("", &warped.report.map);
    written.tell();
    if !warped.report.certified {
        return Err(CommandFailure::uncertified("the map is not valid"));
    }
    CommandFailure::unless_complete(warped.report.completion)
}

/// Prints one line about a map.
pub(super) fn print_pull(name: &str, report: &PullReport) {
    let summary = &report.summary;
    say(format_args!(
        "{name}{:?}: {} iterations, {} factorizations, energy {:.6e} {}, residual {:.1e}, {} inverted, {}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        summary.energy,
        Units::Normalized,
        summary.residual,
        report.certificate.inverted,
        if report.bijective {
            "bijective"
        } else {
            "not bijective"
        }
    ));
}

// Output of commands that deform a body: the map, the report, the trace, frames.

/// Files beside the map.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct Records {
    #[command(flatten)]
    pub(super) files: OutputFiles<BodyFormat>,
    /// Write a CSV file with one line per iteration
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Directory for the map of every iteration, as numbered files in the format of the result; created if missing
    #[arg(long, value_name = "DIR")]
    pub(super) frames: Option<PathBuf>,
}

impl Records {
    /// Checks all output paths.
    pub(super) fn outputs(&self, main: &Path, inputs: &[&Path]) -> Result<Outputs, CommandFailure> {
        let OutputFiles { report, output, .. } = &self.files;
        let outputs = Outputs::check(main, &[report, &self.trace], inputs, output)?;
        self.frames.as_deref().map_or(Ok(()), check_folder)?;
        Ok(outputs)
    }

    /// Creates the progress display, which also writes frames of a format if requested.
    pub(super) fn display(&self, format: BodyFormat) -> Display {
        let talk = &self.files.output.talk;
        match &self.frames {
            Some(folder) => {
                Display::with_frames(talk, folder.clone(), format.extension().to_owned())
            }
            None => Display::new(talk),
        }
    }

    /// Writes everything. Fails if handles are not at their targets.
    pub(super) fn write(
        &self,
        outputs: &Outputs,
        deformed: &Deformed,
    ) -> Result<(), CommandFailure> {
        let others = [
            (&self.files.report, json(&deformed.report)?),
            (&self.trace, deformed.trace.clone().into_bytes()),
        ];
        let others = others
            .each_ref()
            .map(|(path, bytes)| (*path, bytes.as_slice()));
        let written = outputs.write(&deformed.files, &others)?;
        if self.files.output.talk.json {
            print_json(&deformed.report)?;
        }
        summarize(deformed);
        written.tell();
        CommandFailure::unless_complete(deformed.report.completion)
    }
}

fn summarize(Deformed { report, .. }: &Deformed) {
    warn(&report.warnings);
    if let Some(cage) = &report.cage {
        say(format_args!(
            "{} voxels, {} tetrahedra, {} triangles, {} surface vertices, crossings {} before, {} after",
            cage.voxels,
            cage.tets,
            cage.surface_triangles,
            cage.surface_vertices,
            cage.crossings_before.pairs,
            cage.crossings_after.pairs
        ));
    }
    let (summary, quality) = (report.summary, report.quality);
    say(format_args!(
        "{:?}: {} iterations, {} factorizations, energy {:.6e} {}, barrier {:.3e}, residual {:.1e}, {} inverted{}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        quality.energy,
        report.units,
        quality.barrier,
        quality.residual,
        quality.inverted,
        (report.crossings).map_or(String::new(), |n| format!(
            ", {n} crossings of the boundary"
        ))
    ));
}
