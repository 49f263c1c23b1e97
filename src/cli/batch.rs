//! `unwrapd batch`: many meshes, each in a child process.

use std::path::Path;
use std::time::Duration;

use tokio::runtime::Runtime;
use tokio::signal::unix::{SignalKind, signal};

use super::bulk_args::{BulkArgs, Work};
use super::bulk_display::BulkDisplay;
use super::console::{self, Lines, print_json, say};
use super::failure::Failure;
use super::work_args::{JOB_MEMORY, cores, machine_memory, seconds};
use crate::bulk::{self, Extra, Local, Order, Place, Row, Totals, Worker};
use unwrapd_api::Pictures;
use unwrapd_server::jobs::{Contained, Program};

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
pub(super) fn run(args: &Args, program: Program) -> Result<(), Failure> {
    let options = args.bulk.options()?;
    let worker = Local {
        contained: args.contained(&args.bulk.extras(), program),
        options: serde_json::to_value(&options)
            .map_err(|error| Failure::other(error.to_string()))?,
    };
    run_with(&args.bulk, args.concurrency(), worker, &runtime()?)
}

/// Creates the async runtime.
pub(super) fn runtime() -> Result<Runtime, Failure> {
    Runtime::new().map_err(|error| Failure::other(error.to_string()))
}

/// Runs a command over many files with any worker.
pub(super) fn run_with<W: Worker>(
    args: &BulkArgs,
    concurrency: usize,
    worker: W,
    runtime: &Runtime,
) -> Result<(), Failure> {
    if args.quiet || args.json {
        console::direct(Lines::None);
    }
    // Open the output folder.
    let options = args.options()?;
    let Work { assets, summary } = args.work()?;
    let to = &args.output;
    let unwritable = |error| Failure::other(format!("cannot write to {}: {error}", to.display()));
    let place = Place::open(to).map_err(unwritable)?;
    let mut display = BulkDisplay::new(assets.len(), &args.accept, args.quiet);
    // Read the records of earlier runs, or do the work until a signal stops it.
    let rows = if args.summary_only {
        bulk::recorded(&assets, &place)
    } else {
        let order = Order::new(
            assets,
            place.clone(),
            worker.version(),
            &options,
            args.extras(),
        );
        let no_scratch = |error| Failure::other(format!("cannot make temporary files: {error}"));
        let mut order = order.map_err(no_scratch)?;
        order.retries = args.retry_failed;
        order.concurrency = concurrency;
        let mut see = |row: &Row, fate| display.see(row, fate);
        runtime.block_on(async {
            let rows = bulk::run(order, worker, &mut see, stop_signal()?).await;
            rows.ok_or_else(|| {
                Failure::other("stopped by a signal; the same command goes on where it was")
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
    place: &Place,
    rows: &[Row],
    totals: &Totals,
    summary: &str,
) -> Result<(), Failure> {
    let table = bulk::csv(rows, &args.accept);
    let written = table.and_then(|table| place.write(Path::new(summary), &table));
    let path = place.path(Path::new(summary));
    let name = path.display();
    written.map_err(|error| Failure::other(format!("cannot write {name}: {error}")))?;
    say(format_args!("summary: {name}"));
    if args.json {
        print_json(totals)?;
    }
    match totals.assets - totals.accepted {
        0 => Ok(()),
        others => Err(Failure::uncertified(format!(
            "{others} of {} assets are not accepted: see {name}",
            totals.assets
        ))),
    }
}

/// Returns a future that completes on SIGTERM or SIGINT.
fn stop_signal() -> Result<impl Future<Output = ()>, Failure> {
    let listen = |kind| signal(kind).map_err(|error| Failure::other(error.to_string()));
    let mut terminate = listen(SignalKind::terminate())?;
    let mut interrupt = listen(SignalKind::interrupt())?;
    Ok(async move {
        tokio::select! {
            _ = terminate.recv() => {}
            _ = interrupt.recv() => {}
        }
    })
}
