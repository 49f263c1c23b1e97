//! `unwrapd unwrap` and `unwrapd repack`: a mesh file in, the file with certified UVs out.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Deserialize;

use super::console::{CommandFailure, json, print_json, say, warn_of};
use super::files::{
    Mapped, OutputFiles, OutputTarget, Outputs, caller, output_format, read_file, read_upload,
};
use super::progress::Display;
use unwrapd_api::options::help_of;
use unwrapd_files::document::{OutputFormat, Warning};
use unwrapd_pipeline::{
    self as pipeline, AtlasPicture, CommandOptions, GivenSeams, GroupReport, Island, NamedSeams,
    Options, Outcome, RepackOptions, Report, repack_document,
};
use unwrapd_server::jobs::{Gate, Gates};
use unwrapd_worker::quality_of;

/// Runs the command.
pub(super) fn run(args: &UnwrapArgs) -> Result<(), CommandFailure> {
    // Check options and paths before the work.
    let options = args.options()?;
    options.check()?;
    let outputs = args.outputs()?;
    // Read the input and unwrap.
    let began = Instant::now();
    let upload = read_upload(&args.input)?;
    let outputs = outputs.with_resources_of(&upload);
    let files = &args.files;
    let display = Display::new(&files.output.talk);
    let outcome = pipeline::unwrap_document(&upload, &options, &display);
    let told = display.finish()?;
    let outcome = outcome?;
    // Draw the requested pictures.
    let report = json(&outcome.report)?;
    let mut others = vec![(&files.report, report.as_slice())];
    let pictures = &args.pictures;
    let layout = drawn(&outcome, AtlasPicture::Layout, pictures.layout.as_ref())?;
    let heatmap = drawn(&outcome, AtlasPicture::Heatmap, pictures.heatmap.as_ref())?;
    others.extend(layout.iter().map(|png| (&pictures.layout, png.as_slice())));
    others.extend(
        heatmap
            .iter()
            .map(|png| (&pictures.heatmap, png.as_slice())),
    );
    // Write the result, report, and judge it by the gates.
    let written = outputs.write(&outcome.files, &others)?;
    if files.output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome, &told);
    written.tell();
    let seconds = began.elapsed().as_secs_f64();
    args.acceptance.judge(&outcome.report, seconds)
}

/// Draws a picture if there is a path for it.
fn drawn(
    outcome: &Outcome,
    picture: AtlasPicture,
    path: Option<&PathBuf>,
) -> Result<Option<Vec<u8>>, CommandFailure> {
    let drawn = path.map(|_| outcome.pictures.draw(picture));
    Ok(drawn.transpose()?)
}

/// Prints the atlases, the warnings except those that were `told` before, and the certified properties.
pub(super) fn summarize(outcome: &Outcome, told: &[Warning]) {
    let report = &outcome.report;
    super::measure::print_table(&report.groups);
    for group in &report.groups {
        tell_rules(group);
    }
    let new = report.warnings.iter().filter(|it| !told.contains(it));
    new.for_each(|warning| warn_of(&warning.message));
    if report.certified {
        say(format_args!("certified: {}", report.proven));
    }
}

/// Prints what rules for islands did in an atlas.
fn tell_rules(group: &GroupReport) {
    for rule in &group.rules {
        let islands = match rule.islands {
            1 => "1 island".to_owned(),
            n => format!("{n} islands"),
        };
        let density = rule.texels_per_unit;
        let density = density.map_or_else(String::new, |t| format!(", {t:.3} texels per unit"));
        let changed = rule.changed.as_ref();
        let changed = changed.map_or_else(String::new, |all| format!(", {} changed", all.len()));
        let (name, rule) = (&group.label, &rule.rule);
        say(format_args!("{name}: {rule}: {islands}{density}{changed}"));
    }
}

// The arguments of `unwrapd unwrap`: files, and the options of the library.

/// The arguments of `unwrap`.
#[derive(clap::Args)]
pub(super) struct UnwrapArgs {
    /// Mesh: .glb, .gltf, .obj, .off, .ply or .stl; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    #[command(flatten)]
    target: OutputTarget,
    #[command(flatten)]
    pub(super) files: OutputFiles<OutputFormat>,
    #[command(flatten)]
    pub(super) pictures: PictureArgs,
    #[command(flatten)]
    pub(super) acceptance: Acceptance,
    #[arg(
        long,
        value_name = "normals|S.json",
        help_heading = "Where to cut",
        help = help_of::<Options>("seams")
    )]
    seams: Option<PathBuf>,
    #[arg(
        long,
        value_name = "V,…",
        value_delimiter = ',',
        help_heading = "Where to cut",
        help = help_of::<Options>("cone_vertices")
    )]
    cone_vertices: Option<Vec<u32>>,
    #[command(flatten)]
    options: Options,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct PictureArgs {
    /// Write a picture of the UV layout
    #[arg(long, value_name = "L.png")]
    pub(super) layout: Option<PathBuf>,
    /// Write a heat map of the distortion
    #[arg(long, value_name = "H.png")]
    pub(super) heatmap: Option<PathBuf>,
}

impl UnwrapArgs {
    /// Returns the options; reads the file of seams if one is given.
    pub(super) fn options(&self) -> Result<Options, CommandFailure> {
        let output = &self.target.output;
        Ok(Options {
            seams: self.seams.as_deref().map(given_seams).transpose()?,
            cone_vertices: self.cone_vertices.clone(),
            format: output_format(output, self.files.format)?,
            caller: caller(output),
            ..self.options.clone()
        })
    }

    /// Checks and returns all output paths.
    pub(super) fn outputs(&self) -> Result<Outputs, CommandFailure> {
        let PictureArgs { layout, heatmap } = &self.pictures;
        let OutputFiles { report, output, .. } = &self.files;
        let seams = self.seams.as_deref().filter(|path| !is_word(path));
        let inputs: Vec<&Path> = [self.input.as_path()].into_iter().chain(seams).collect();
        let others = [report, layout, heatmap];
        Outputs::check(&self.target.output, &others, &inputs, output)
    }
}

fn is_word(path: &Path) -> bool {
    path.as_os_str() == "normals"
}

/// Returns the seams for the word `normals`, or reads the pairs in a file.
fn given_seams(path: &Path) -> Result<GivenSeams, CommandFailure> {
    if is_word(path) {
        return Ok(GivenSeams::Named(NamedSeams::Normals));
    }
    let edges = serde_json::from_slice(&read_file(path)?);
    let edges =
        edges.map_err(|error| CommandFailure::input(format!("{}: {error}", path.display())))?;
    Ok(GivenSeams::Edges(edges))
}

// Acceptance gates for exit status 0.

/// The gates of a command.
#[derive(clap::Args)]
pub(super) struct Acceptance {
    /// Gates that the result must meet for exit status 0, as a list with commas
    ///
    /// Gates are certified, max_charts=N, max_distortion=E, max_stretch=S, max_seconds=T and
    /// written. Distortion and stretch are those of the worst atlas: the mean energy, and the 99th
    /// percentile.
    #[arg(
        long,
        value_name = "GATES",
        default_value = "certified",
        help_heading = "Files and messages"
    )]
    accept: Gates,
}

impl Acceptance {
    /// Returns a failure if a result that took this many seconds misses a gate, or was only partly done. The result
    /// is written in any case.
    pub(super) fn judge(&self, report: &Report, seconds: f64) -> Result<(), CommandFailure> {
        let quality = quality_of(report);
        let missed: Vec<&Gate> = self.accept.missed(&quality, seconds).collect();
        if missed.is_empty() && report.partly_done {
            let message = "certified, but not all textures and colors were resampled (partly_done)";
            return Err(CommandFailure::partly(message));
        }
        if missed.is_empty() {
            return Ok(());
        }
        if missed.contains(&&Gate::Certified) {
            let missing = report.lacking();
            return Err(CommandFailure::uncertified(format!(
                "not certified, but written: {} (not_certified)",
                missing.join(", ")
            )));
        }
        let missed: Vec<String> = missed.into_iter().map(ToString::to_string).collect();
        Err(CommandFailure::uncertified(format!(
            "not accepted, but written: {} (not_accepted)",
            missed.join(", ")
        )))
    }
}

// `unwrapd repack`: packing of existing UVs.

/// The arguments of `repack`.
#[derive(clap::Args)]
pub(super) struct RepackArgs {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    target: OutputTarget,
    #[command(flatten)]
    files: OutputFiles<OutputFormat>,
    #[command(flatten)]
    acceptance: Acceptance,
    #[arg(
        long,
        value_name = "I.json",
        help_heading = "Atlas",
        help = help_of::<RepackOptions>("islands")
    )]
    islands: Option<PathBuf>,
    #[command(flatten)]
    options: RepackOptions,
}

/// Runs the command.
pub(super) fn repack(args: &RepackArgs) -> Result<(), CommandFailure> {
    // Check options and paths before the work.
    let (input, to) = (&args.mapped.input, &args.target.output);
    let mut options = RepackOptions {
        format: output_format(to, args.files.format)?,
        caller: caller(to),
        ..args.options.clone()
    };
    options.check()?;
    let (report, output) = (&args.files.report, &args.files.output);
    let islands = args.islands.as_deref();
    let inputs: Vec<&Path> = [input.as_path()].into_iter().chain(islands).collect();
    let outputs = Outputs::check(to, &[report], &inputs, output)?;
    if let Some(islands) = islands {
        options.islands = given_islands(islands)?;
        options.check()?;
    }
    // Read the input and pack.
    let began = Instant::now();
    let upload = read_upload(input)?;
    let outputs = outputs.with_resources_of(&upload);
    let display = Display::new(&output.talk);
    let outcome = repack_document(&upload, &options, &display);
    let told = display.finish()?;
    let outcome = outcome?;
    // Write the result, report, and judge it by the gates.
    let written = outputs.write(&outcome.files, &[(report, &json(&outcome.report)?)])?;
    if output.talk.json {
        print_json(&outcome.report)?;
    }
    summarize(&outcome, &told);
    written.tell();
    let seconds = began.elapsed().as_secs_f64();
    args.acceptance.judge(&outcome.report, seconds)
}

/// Reads the islands in a file.
fn given_islands(path: &Path) -> Result<Vec<Island>, CommandFailure> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct SeamsFile {
        islands: Vec<Island>,
    }
    let file: Result<SeamsFile, _> = serde_json::from_slice(&read_file(path)?);
    let file =
        file.map_err(|error| CommandFailure::input(format!("{}: {error}", path.display())))?;
    Ok(file.islands)
}
