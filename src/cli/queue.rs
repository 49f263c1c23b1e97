//! `unwrapd queue`: status of the queue, pausing and resuming it, and retrying failed jobs.

use serde::Serialize;

use super::console::{CommandFailure, print, print_json};
use super::store_args::StoreArgs;
use unwrapd_server::jobs::access::{Owner, Visibility};
use unwrapd_server::jobs::{JobStore, Listing, StoreError, retry_failed};
use unwrapd_server::store::RecordStore;

/// The arguments of `queue`.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(subcommand)]
    action: QueueAction,
}

#[derive(clap::Subcommand)]
enum QueueAction {
    /// Print how many jobs there are in each state, and whether waiting ones are started
    Status(QueueStatus),
    /// Start no waiting job from now on, in any process. Jobs are accepted, and running ones end
    Pause(StoreArgs),
    /// Start waiting jobs again
    Resume(StoreArgs),
    /// Try failed jobs again, all or those that failed with a code
    Retry(Retry),
}

#[derive(clap::Args)]
struct QueueStatus {
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    store: StoreArgs,
}

#[derive(clap::Args)]
struct Retry {
    /// Only jobs that failed with this code, such as worker_lost
    #[arg(long, value_name = "CODE")]
    code: Option<String>,
    /// Only jobs of this owner
    #[arg(long, value_name = "NAME")]
    owner: Option<Owner>,
    #[command(flatten)]
    store: StoreArgs,
}

/// The queue as it is printed.
#[derive(Serialize)]
struct PrintedQueue {
    paused: bool,
    oldest_queued_seconds: f64,
    jobs: serde_json::Map<String, serde_json::Value>,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let runtime = super::batch::runtime()?;
    runtime.block_on(async {
        match &args.action {
            QueueAction::Status(args) => status(args).await,
            QueueAction::Pause(args) => set_paused(args, true).await,
            QueueAction::Resume(args) => set_paused(args, false).await,
            QueueAction::Retry(args) => retry(args).await,
        }
    })
}

async fn set_paused(args: &StoreArgs, paused: bool) -> Result<(), CommandFailure> {
    let set = args.present().await?.set_paused(paused).await;
    set.map_err(|error| CommandFailure::other(format!("nothing was changed: {error}")))
}

async fn retry(args: &Retry) -> Result<(), CommandFailure> {
    let store = args.store.opened().await?;
    let mut listing = Listing {
        owner: args.owner.clone(),
        ..Listing::default()
    };
    let mut count = 0;
    loop {
        let code = args.code.as_deref();
        let retried = retry_failed(&store, &Visibility::All, listing.clone(), code).await;
        let retried = retried.map_err(|error| {
            CommandFailure::other(format!("{count} jobs tried again, then: {error}"))
        })?;
        count += retried.jobs.len();
        if retried.next.is_none() {
            break;
        }
        listing.after = retried.next;
    }
    print(format!("{count} jobs queued again"));
    Ok(())
}

async fn status(args: &QueueStatus) -> Result<(), CommandFailure> {
    let store = args.store.present().await?;
    let printed = printed(&store).await;
    let printed =
        printed.map_err(|error| CommandFailure::other(format!("no jobs read: {error}")))?;
    if args.json {
        return print_json(&printed);
    }
    print(if printed.paused { "paused" } else { "running" }.to_owned());
    for (state, count) in &printed.jobs {
        print(format!("{state}\t{count}"));
    }
    let waits = printed.oldest_queued_seconds;
    print(format!("oldest queued\t{waits:.0} s"));
    Ok(())
}

async fn printed(store: &RecordStore) -> Result<PrintedQueue, StoreError> {
    let queue = store.queue().await?;

    Ok(PrintedQueue {
        paused: store.is_paused().await?,
        oldest_queued_seconds: queue.oldest_wait.as_secs_f64(),
        jobs: (queue.counts.into_iter())
            .map(|(state, count)| (state.word().to_owned(), count.into()))
            .collect(),
    })
}
