//! Common arguments of commands over many files: inputs, outputs, gates.

use std::path::{Path, PathBuf};

use super::console::warn_of;
use super::failure::Failure;
use super::input::{folder, read_file};
use crate::bulk::{self, Asset, Extra, ShardChoice, array_variable};
use unwrapd_api::options::help_of;
use unwrapd_files::document::OutputFormat;
use unwrapd_pipeline::{CommandOptions, GivenSeams, NamedSeams, Options};
use unwrapd_server::jobs::Gates;

/// The arguments of commands over many files.
#[derive(clap::Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "switches of the command line"
)]
pub(super) struct BulkArgs {
    /// Directory of meshes, with its subdirectories: .glb, .gltf, .obj, .off, .ply and .stl
    #[arg(
        value_name = "FOLDER",
        required_unless_present = "manifest",
        conflicts_with = "manifest"
    )]
    folder: Option<PathBuf>,
    /// File with a mesh per line, counted from its own directory; `-` is standard input
    ///
    /// After a tab, a line can name the output, counted from DIR. Otherwise the output is named
    /// like the mesh.
    #[arg(long, value_name = "M")]
    manifest: Option<PathBuf>,
    /// Output directory; created if missing
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: PathBuf,
    /// Do only one part of the list: I of N, or what the scheduler says
    ///
    /// I counts from 1. `auto` reads JOB_COMPLETION_INDEX (Kubernetes), SLURM_ARRAY_TASK_ID or
    /// AWS_BATCH_JOB_ARRAY_INDEX, which count from 0. Slurm and AWS Batch also tell the number of
    /// shards; `auto/N` sets it. All shards need the same list.
    #[arg(long, value_name = "I/N|auto[/N]")]
    shard: Option<ShardChoice>,
    /// Gates that every asset must meet for exit status 0, as a list with commas
    ///
    /// Gates are written, certified, max_charts=N, max_distortion=E, max_stretch=S and
    /// max_seconds=T. Distortion and stretch are those of the worst atlas of an asset: the mean
    /// energy, and the 99th percentile. An asset without an output meets none.
    #[arg(long, value_name = "GATES", default_value = "certified")]
    pub(super) accept: Gates,
    /// Format of the outputs
    #[arg(long, default_value = "glb", help_heading = "Files and messages")]
    format: OutputFormat,
    /// Also write the report of each output as NAME.report.json
    #[arg(long, help_heading = "Files and messages")]
    report: bool,
    /// Also write a picture of each UV layout as NAME.layout.png
    #[arg(long, help_heading = "Files and messages")]
    layout: bool,
    /// Also write a heat map of each distortion as NAME.heatmap.png
    #[arg(long, help_heading = "Files and messages")]
    heatmap: bool,
    /// Also repeat assets whose failure is certain to be the same, such as unusable meshes
    ///
    /// Failures that may pass, such as a lack of memory or time, are always repeated.
    #[arg(long)]
    pub(super) retry_failed: bool,
    /// Only write the summary of what earlier runs did
    #[arg(long, conflicts_with = "retry_failed")]
    pub(super) summary_only: bool,
    /// Print only warnings and errors
    #[arg(short, long, help_heading = "Files and messages")]
    pub(super) quiet: bool,
    /// Print the totals as JSON
    #[arg(long, help_heading = "Files and messages")]
    pub(super) json: bool,
    #[arg(
        long,
        value_name = "normals",
        help_heading = "Where to cut",
        help = help_of::<Options>("seams")
    )]
    seams: Option<NamedSeams>,
    #[command(flatten)]
    options: Options,
}

/// Assets of a run, and the name of its summary.
pub(super) struct Work {
    pub(super) assets: Vec<Asset>,
    /// Name of the summary.
    pub(super) summary: String,
}

impl BulkArgs {
    /// Returns the options of every asset after checking them.
    pub(super) fn options(&self) -> Result<Options, Failure> {
        let options = Options {
            seams: self.seams.map(GivenSeams::Named),
            format: self.format,
            ..self.options.clone()
        };
        options.check()?;
        Ok(options)
    }

    /// Returns the files to write beside outputs.
    pub(super) fn extras(&self) -> Vec<Extra> {
        let all = [
            (self.report, Extra::Report),
            (self.layout, Extra::Layout),
            (self.heatmap, Extra::Heatmap),
        ];
        all.into_iter()
            .filter_map(|(is_given, extra)| is_given.then_some(extra))
            .collect()
    }

    /// Lists the assets of this shard.
    pub(super) fn work(&self) -> Result<Work, Failure> {
        let variable = |name: &str| std::env::var(name).ok();
        let assets = self.assets()?;
        let Some(choice) = self.shard else {
            if let Some(name) = array_variable(variable) {
                warn_of(format_args!(
                    "{name} is set, but without --shard auto every task does all assets"
                ));
            }
            let summary = "summary.csv".to_owned();
            return Ok(Work { assets, summary });
        };
        let shard = choice.resolved(variable);
        let shard = shard.map_err(|error| Failure::usage(format!("--shard: {error}")))?;
        let own = assets.into_iter().enumerate();
        let own = own.filter_map(|(place, asset)| shard.contains(place).then_some(asset));
        Ok(Work {
            assets: own.collect(),
            summary: format!("summary-{}-of-{}.csv", shard.number(), shard.count()),
        })
    }

    fn assets(&self) -> Result<Vec<Asset>, Failure> {
        let (to, format) = (&self.output, self.format);
        if let Some(manifest) = &self.manifest {
            let bytes = read_file(manifest)?;
            let name = manifest.display().to_string();
            let root = folder(manifest);
            return Ok(bulk::assets_of(&name, &bytes, &root, to, format)?);
        }
        let folder = self.folder.as_deref().unwrap_or(Path::new("."));
        let listing = bulk::assets_in(folder, to, format)?;
        for link in &listing.links {
            warn_of(format_args!(
                "{} is a link to a directory, which is not followed",
                link.display()
            ));
        }
        Ok(listing.assets)
    }
}
