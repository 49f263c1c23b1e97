//! `unwrapd check`: comparison of records and files.

use serde::Serialize;

use super::console::{CommandFailure, print, print_json};
use super::process::blobs_url;
use super::store_args::StoreArgs;
use unwrapd_server::jobs::{
    Blobs, Inspection, JobStore, Loss, Quarantined, StoreError, adopt, inspect, purge, repair,
    shared_identity,
};
use unwrapd_server::store::blobs_at;

/// The arguments of `check`.
#[derive(clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
pub(super) struct Args {
    #[command(flatten)]
    store: StoreArgs,
    /// Place for files, if the service has one: s3://BUCKET/PREFIX or file:///DIR
    #[arg(long, value_name = "URL", env = "UNWRAPD_BLOBS_URL")]
    blobs: Option<String>,
    /// Put files without a job into quarantine, and copy no damaged result for equal jobs
    #[arg(long)]
    repair: bool,
    /// Delete what is in quarantine now, however much it is
    #[arg(long)]
    purge: bool,
    /// Take the database and the files for one store from now on, whatever they were
    #[arg(long)]
    adopt: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The findings, as printed.
#[derive(Serialize)]
struct PrintedCheck {
    jobs: usize,
    files: usize,
    missing: Vec<String>,
    damaged: Vec<String>,
    unknown: Vec<UnknownFiles>,
}

/// Files without a job, with their time in quarantine.
#[derive(Serialize)]
struct UnknownFiles {
    job: String,
    bytes: u64,
    quarantine_days: Option<f64>,
}

/// Seconds per day.
const DAY_SECONDS: f64 = 86_400.0;

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let runtime = super::batch::runtime()?;
    runtime.block_on(check(args))
}

async fn check(args: &Args) -> Result<(), CommandFailure> {
    // Open the store.
    let data = &args.store.data;
    if args.store.database.is_none() && !data.exists() {
        return Err(CommandFailure::other(format!(
            "there is no {}",
            data.display()
        )));
    }
    let store = args.store.opened().await?;
    let url = blobs_url(data, args.blobs.as_deref()).map_err(CommandFailure::other)?;
    let blobs = blobs_at(&url).map_err(|error| failed(&error))?;
    // Compare, print, and fail if anything was found.
    let found = compared(args, &store, blobs.as_ref()).await;
    let (found, quarantined) = found.map_err(|error| failed(&error))?;
    let printed = PrintedCheck::of(&found, &quarantined);
    if args.json {
        print_json(&printed)?;
    } else {
        printed.print();
    }
    if printed.missing.is_empty() && printed.damaged.is_empty() && printed.unknown.is_empty() {
        return Ok(());
    }
    Err(CommandFailure::other(format!(
        "{} files missing, {} damaged, files of {} jobs without a record",
        printed.missing.len(),
        printed.damaged.len(),
        printed.unknown.len()
    )))
}

fn failed(error: &StoreError) -> CommandFailure {
    CommandFailure::other(error.to_string())
}

async fn compared(
    args: &Args,
    store: &dyn JobStore,
    blobs: &dyn Blobs,
) -> Result<(Inspection, Vec<Quarantined>), StoreError> {
    if args.adopt {
        adopt(store, blobs).await?;
    }
    shared_identity(store, blobs).await?;
    if args.purge {
        let purged = purge(store, blobs).await?;
        eprintln!("unwrapd: files of {purged} jobs deleted");
    }
    let found = inspect(store, blobs).await?;
    if args.repair {
        repair(store, &found).await?;
    }
    Ok((found, store.quarantined().await?))
}

impl PrintedCheck {
    fn of(found: &Inspection, quarantined: &[Quarantined]) -> Self {
        let (mut missing, mut damaged) = (Vec::new(), Vec::new());
        for file in &found.lost {
            match file.loss {
                Loss::Missing => missing.push(file.key.clone()),
                Loss::Damaged => damaged.push(file.key.clone()),
            }
        }
        let unknown = found.unknown.iter().map(|(job, bytes)| {
            let quarantine = quarantined.iter().find(|files| files.job == *job);
            UnknownFiles {
                job: job.to_string(),
                bytes: *bytes,
                quarantine_days: quarantine.map(|files| files.age.as_secs_f64() / DAY_SECONDS),
            }
        });
        Self {
            jobs: found.jobs,
            files: found.files,
            missing,
            damaged,
            unknown: unknown.collect(),
        }
    }

    fn print(&self) {
        for (word, keys) in [("missing", &self.missing), ("damaged", &self.damaged)] {
            for key in keys {
                print(format!("{word}\t{key}"));
            }
        }
        for files in &self.unknown {
            let quarantine = files.quarantine_days.map_or_else(
                || "not in quarantine".to_owned(),
                |days| format!("in quarantine for {days:.1} days"),
            );
            print(format!(
                "unknown\t{}\t{} bytes\t{quarantine}",
                files.job, files.bytes
            ));
        }
        print(format!("{} jobs, {} files", self.jobs, self.files));
    }
}
