//! `unwrapd worker`: computes jobs that services on other machines accept.

use std::sync::Arc;

use super::process::{self, WorkArgs, measured};
use unwrapd_server::jobs::Program;

/// The arguments of `worker`. Each has an environment variable.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    work: WorkArgs,
}

/// Works until SIGTERM or SIGINT.
pub(super) fn run(args: &Args, program: Program) -> Result<(), String> {
    if args.work.store.database.is_none() {
        let why = "a worker needs a database that it shares: --database and --blobs";
        return Err(why.to_owned());
    }
    if args.work.workers == Some(0) {
        return Err("--workers must be at least 1".to_owned());
    }
    process::run(&args.work, work(args, program))
}

async fn work(args: &Args, program: Program) -> Result<(), String> {
    let settings = args.work.settings(program);
    let grace = settings.grace;
    let measured = measured()?;
    let (jobs, _) = process::queue(&args.work, settings).await?;
    let stop = process::stop_on_signals()?;
    let shown = Arc::clone(&jobs);
    let watch = &args.work.watch;
    watch.exposition(measured, shown, None, &stop).await?;
    tracing::info!("waiting for jobs");
    let queue = tokio::spawn(jobs.run(stop.clone()));
    stop.cancelled().await;
    match process::stopped(grace, queue).await {
        Some(ended) => ended.map_err(|error| error.to_string()),
        None => Err("jobs were still running".to_owned()),
    }
}
