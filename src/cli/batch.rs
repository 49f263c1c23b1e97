//! `unwrapd batch` and `unwrapd submit`: many meshes, each in a child process or as a job of a service.

use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use tokio::runtime::Runtime;
use tokio::signal::unix::{Signal, SignalKind, signal};

use super::console::{self, CommandFailure, LineTarget, one_line, print_json, say, warn_of};
use super::files::{folder, read_file};
use super::process::{JOB_MEMORY, cores, machine_memory, seconds};
use crate::bulk::{
    self, Asset, AssetStatus, Extra, Fate, Figures, LocalWorker, OutputFolder, RemoteWorker,
    RunOrder, ShardChoice, SummaryRow, Totals, Worker, array_variable,
};
use unwrapd_api::Pictures;
use unwrapd_api::options::help_of;
use unwrapd_files::document::OutputFormat;
use unwrapd_pipeline::{CommandOptions, GivenSeams, NamedSeams, Options};
use unwrapd_server::jobs::{Contained, Gates, Program};

/// The arguments of `batch`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Number of assets unwrapped at the same time [default: the number of cores]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Time limit of an asset, in seconds. When it is reached, the current valid map becomes the
    /// result. An asset that has none fails after a quarter of the limit more, or 10 s if that is
    /// longer
    ///
    /// A later run keeps such a result, unless its limit is higher.
    #[arg(long, value_name = "S", default_value_t = 600.0, value_parser = seconds)]
    asset_seconds: f64,
    /// Memory limit of an asset, in MiB [default: 8192, or an equal part of the machine's if less]
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u64).range(16..))]
    asset_memory_mib: Option<u64>,
    #[command(flatten)]
    bulk: BulkArgs,
}

impl Args {
    fn contained(&self, extras: &[Extra], program: Program) -> Contained {
        let n_jobs = self.concurrency() as u64;
        let memory = self.asset_memory_mib.map(|mib| mib.saturating_mul(1 << 20));
        let is_drawn = extras.iter().any(|extra| *extra != Extra::Report);
        Contained {
            program,
            threads: (cores() / self.concurrency()).max(1),
            time: Duration::from_secs_f64(self.asset_seconds),
            memory: memory.unwrap_or_else(|| JOB_MEMORY.min(machine_memory() / n_jobs)),
            pictures: if is_drawn {
                Pictures::Drawn
            } else {
                Pictures::LeftOut
            },
        }
    }

    fn concurrency(&self) -> usize {
        self.jobs.map_or(cores(), usize::from)
    }
}

/// Runs the command.
pub(super) fn run(args: &Args, program: Program) -> Result<(), CommandFailure> {
    let options = args.bulk.options()?;
    let worker = LocalWorker {
        contained: args.contained(&args.bulk.extras(), program),
        options: serde_json::to_value(&options)
            .map_err(|error| CommandFailure::other(error.to_string()))?,
    };
    run_with(&args.bulk, args.concurrency(), worker, &runtime()?)
}

/// Creates the async runtime.
pub(super) fn runtime() -> Result<Runtime, CommandFailure> {
    Runtime::new().map_err(|error| CommandFailure::other(error.to_string()))
}

/// Runs a command over many files with any worker.
fn run_with<W: Worker>(
    args: &BulkArgs,
    concurrency: usize,
    worker: W,
    runtime: &Runtime,
) -> Result<(), CommandFailure> {
    if args.quiet || args.json {
        console::direct(LineTarget::None);
    }
    // Open the output folder.
    let options = args.options()?;
    let BulkWork { assets, summary } = args.work()?;
    let to = &args.output;
    let place = OutputFolder::open(to).map_err(|error| {
        CommandFailure::other(format!("cannot write to {}: {error}", to.display()))
    })?;
    let mut display = BulkDisplay::new(assets.len(), &args.accept, args.quiet);
    // Read the records of earlier runs, or do the work until a signal stops it.
    let rows = if args.summary_only {
        bulk::recorded(&assets, &place)
    } else {
        let order = RunOrder::new(
            assets,
            place.clone(),
            worker.version(),
            &options,
            args.extras(),
        );
        let mut order = order.map_err(|error| {
            CommandFailure::other(format!("cannot make temporary files: {error}"))
        })?;
        order.retries = args.retry_failed;
        order.concurrency = concurrency;
        runtime.block_on(async {
            let rows = bulk::run(
                order,
                worker,
                &mut |row: &SummaryRow, fate| display.see(row, fate),
                stop_signal()?,
            )
            .await;
            rows.ok_or_else(|| {
                CommandFailure::other("stopped by a signal; the same command goes on where it was")
            })
        })?
    };
    // Write the summary and judge the totals.
    let totals = Totals::of(&rows, &args.accept);
    display.finish(&totals);
    conclude(args, &place, &rows, &totals, &summary)
}

/// Writes the summary, and fails if assets are not accepted.
fn conclude(
    args: &BulkArgs,
    place: &OutputFolder,
    rows: &[SummaryRow],
    totals: &Totals,
    summary: &str,
) -> Result<(), CommandFailure> {
    let table = bulk::csv(rows, &args.accept);
    let written = table.and_then(|table| place.write(Path::new(summary), &table));
    let path = place.path(Path::new(summary));
    let name = path.display();
    written.map_err(|error| CommandFailure::other(format!("cannot write {name}: {error}")))?;
    say(format_args!("summary: {name}"));
    if args.json {
        print_json(totals)?;
    }
    match totals.assets - totals.accepted {
        0 => Ok(()),
        others => Err(CommandFailure::uncertified(format!(
            "{others} of {} assets are not accepted: see {name}",
            totals.assets
        ))),
    }
}

/// Returns a future that completes on SIGTERM or SIGINT.
fn stop_signal() -> Result<impl Future<Output = ()>, CommandFailure> {
    let mut terminate = listener_of(SignalKind::terminate())?;
    let mut interrupt = listener_of(SignalKind::interrupt())?;
    Ok(async move {
        tokio::select! {
            _ = terminate.recv() => {}
            _ = interrupt.recv() => {}
        }
    })
}

fn listener_of(kind: SignalKind) -> Result<Signal, CommandFailure> {
    signal(kind).map_err(|error| CommandFailure::other(error.to_string()))
}

// Common arguments of commands over many files: inputs, outputs, gates.

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
pub(super) struct BulkWork {
    pub(super) assets: Vec<Asset>,
    /// Name of the summary.
    pub(super) summary: String,
}

impl BulkArgs {
    /// Returns the options of every asset after checking them.
    pub(super) fn options(&self) -> Result<Options, CommandFailure> {
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
    pub(super) fn work(&self) -> Result<BulkWork, CommandFailure> {
        let assets = self.assets()?;
        let Some(choice) = self.shard else {
            if let Some(name) = array_variable(environment) {
                warn_of(format_args!(
                    "{name} is set, but without --shard auto every task does all assets"
                ));
            }
            let summary = "summary.csv".to_owned();
            return Ok(BulkWork { assets, summary });
        };
        let shard = choice.resolved(environment);
        let shard = shard.map_err(|error| CommandFailure::usage(format!("--shard: {error}")))?;
        let own = assets.into_iter().enumerate();
        let own = own.filter_map(|(place, asset)| shard.contains(place).then_some(asset));
        Ok(BulkWork {
            assets: own.collect(),
            summary: format!("summary-{}-of-{}.csv", shard.number(), shard.count()),
        })
    }

    fn assets(&self) -> Result<Vec<Asset>, CommandFailure> {
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

/// Returns the value of an environment variable, if it is text.
fn environment(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

// Progress over many files on standard error: a bar on a terminal, otherwise a line per asset.

/// Display of a run's progress.
pub(super) struct BulkDisplay<'a> {
    gates: &'a Gates,
    n_assets: usize,
    n_kept: usize,
    n_done: usize,
    /// Number of outputs of this run.
    n_made: usize,
    begin: Instant,
    bar: Option<ProgressBar>,
    is_quiet: bool,
}

impl<'a> BulkDisplay<'a> {
    pub(super) fn new(n_assets: usize, gates: &'a Gates, is_quiet: bool) -> Self {
        let bar = (!is_quiet && stderr().is_terminal()).then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(10);
            let bar = ProgressBar::with_draw_target(Some(n_assets as u64), target);
            let style = "{bar:30} {pos} of {len} {elapsed} left {eta} {msg}";
            let style = ProgressStyle::with_template(style);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self {
            gates,
            n_assets,
            n_kept: 0,
            n_done: 0,
            n_made: 0,
            begin: Instant::now(),
            bar,
            is_quiet,
        }
    }

    /// Shows a finished asset.
    pub(super) fn see(&mut self, row: &SummaryRow, fate: Fate) {
        // Count the asset.
        match fate {
            Fate::Kept => self.n_kept += 1,
            Fate::Done => self.n_done += 1,
        }
        self.n_made +=
            usize::from(fate == Fate::Done && matches!(row.status, AssetStatus::Written(_)));
        // Print a line: on a terminal only for rejected assets, since the bar shows the others.
        let is_accepted = row.is_accepted(self.gates);
        let is_told = match fate {
            Fate::Kept => false,
            Fate::Done => !is_accepted || (self.bar.is_none() && !self.is_quiet),
        };
        let number = self.n_kept + self.n_done;
        if is_told {
            let mark = if is_accepted { "" } else { ", not accepted" };
            let text = format!(
                "{number} of {}  {}{mark}",
                self.n_assets,
                one_line(&text_of(row))
            );
            match &self.bar {
                Some(bar) => bar.println(text),
                None => eprintln!("{text}"),
            }
        }
        if let Some(bar) = &self.bar {
            bar.set_position(number as u64);
        }
    }

    /// Removes the bar and prints the totals.
    pub(super) fn finish(self, totals: &Totals) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        let hours = self.begin.elapsed().as_secs_f64() / 3600.0;
        let speed = match self.n_made {
            0 => String::new(),
            made => format!(", {:.0} an hour", made as f64 / hours),
        };
        say(format_args!(
            "{} assets: {} written, {} failed, {} missing, {} accepted; {} done now, {} before{speed}",
            totals.assets,
            totals.written,
            totals.failed,
            totals.missing,
            totals.accepted,
            self.n_done,
            self.n_kept
        ));
    }
}

fn text_of(row: &SummaryRow) -> String {
    let name = &row.input;
    match &row.status {
        AssetStatus::Written(Figures {
            certified, charts, ..
        }) => {
            let verdict = if *certified {
                "certified"
            } else {
                "not certified"
            };
            format!("{name}: {charts} charts, {verdict}, {:.2} s", row.seconds)
        }
        AssetStatus::Failed { code, detail } => format!("{name}: {detail} ({code})"),
        AssetStatus::Missing => format!("{name}: missing"),
    }
}

// `unwrapd submit`: many meshes, each as a job of a service.

/// The arguments of `submit`.
#[derive(clap::Args)]
pub(super) struct SubmitArgs {
    /// Address of the service, such as http://127.0.0.1:8080
    #[arg(long, value_name = "URL", env = "UNWRAPD_SERVER")]
    server: String,
    /// API key, if the service asks for one. In the environment it is not seen by other users of the
    /// machine
    #[arg(long, value_name = "KEY", env = "UNWRAPD_KEY", hide_env_values = true)]
    key: Option<String>,
    /// Number of jobs submitted at the same time
    #[arg(
        short,
        long,
        value_name = "N",
        default_value_t = 8,
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    jobs: u16,
    /// Have every asset computed, even if the service has the result of an equal job
    ///
    /// A run that follows within a day finds the jobs that this one made.
    #[arg(long)]
    no_cache: bool,
    #[command(flatten)]
    bulk: BulkArgs,
}

/// Runs the command.
pub(super) fn submit(args: &SubmitArgs) -> Result<(), CommandFailure> {
    let options = serde_json::to_value(args.bulk.options()?);
    let options = options.map_err(|error| CommandFailure::other(error.to_string()))?;
    let runtime = runtime()?;
    let remote = RemoteWorker::connect(
        &args.server,
        args.key.as_deref(),
        &options,
        args.bulk.extras(),
    );
    let mut remote = runtime.block_on(remote)?;
    remote.is_fresh = args.no_cache;
    run_with(&args.bulk, usize::from(args.jobs), remote, &runtime)
}
