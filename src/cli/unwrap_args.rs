//! The arguments of `unwrapd unwrap`: files, and the options of the library.

use std::path::{Path, PathBuf};

use super::acceptance::Acceptance;
use super::failure::Failure;
use super::format::output_format;
use super::input::read_file;
use super::output::{Files, Outputs, Target, caller};
use unwrapd_api::options::help_of;
use unwrapd_files::document::OutputFormat;
use unwrapd_pipeline::{GivenSeams, NamedSeams, Options};

/// The arguments of `unwrap`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh: .glb, .gltf, .obj, .off, .ply or .stl; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    #[command(flatten)]
    target: Target,
    #[command(flatten)]
    pub(super) files: Files<OutputFormat>,
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

impl Args {
    /// Returns the options; reads the file of seams if one is given.
    pub(super) fn options(&self) -> Result<Options, Failure> {
        let output = &self.target.output;
        Ok(Options {
            seams: self.seams.as_deref().map(given_seams).transpose()?,
            format: output_format(output, self.files.format)?,
            caller: caller(output),
            ..self.options.clone()
        })
    }

    /// Checks and returns all output paths.
    pub(super) fn outputs(&self) -> Result<Outputs, Failure> {
        let PictureArgs { layout, heatmap } = &self.pictures;
        let Files { report, output, .. } = &self.files;
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
fn given_seams(path: &Path) -> Result<GivenSeams, Failure> {
    if is_word(path) {
        return Ok(GivenSeams::Named(NamedSeams::Normals));
    }
    let edges = serde_json::from_slice(&read_file(path)?);
    let edges = edges.map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
    Ok(GivenSeams::Edges(edges))
}
