//! A process that works on jobs: log, folder, stores, shutdown.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tokio::signal::unix::{SignalKind, signal};
use tokio_util::sync::CancellationToken;

use super::store_args::url_path;
use super::work_args::WorkArgs;
use unwrapd_server::jobs::{Blobs, JobStore, Jobs, Settings};
use unwrapd_server::store::{RecordStore, blobs_at};

/// Time for connections and computations to end after the stop signal and the grace period. A longer time delays the
/// exit if a client does not close its connection; a shorter one cuts off responses.
const STOP_TIME: Duration = Duration::from_secs(10);

/// Runs a process on its folder until it ends.
pub(super) fn run(
    args: &WorkArgs,
    process: impl Future<Output = Result<(), String>>,
) -> Result<(), String> {
    args.watch.start_log();
    args.store.make_folder()?;
    let _lock = lock(&args.store.data)?;
    tokio::runtime::Runtime::new()
        .map_err(|error| error.to_string())?
        .block_on(process)
}

/// Locks a data folder, so that no two processes use it. The lock is released when the process ends.
fn lock(data: &Path) -> Result<File, String> {
    let path = data.join("lock");
    let lock = File::create(&path)
        .map_err(|error| format!("cannot create {}: {error}", path.display()))?;
    lock.try_lock()
        .map_err(|_| format!("another server uses {}", data.display()))?;
    Ok(lock)
}

/// Returns the URL of file storage: the given one, or a part of the data folder.
pub(super) fn blobs_url(data: &Path, named: Option<&str>) -> Result<String, String> {
    match named {
        Some(blobs) => Ok(blobs.to_owned()),
        None => Ok(format!("file://{}", url_path(&data.join("blobs"))?)),
    }
}

/// Opens the stores, recovers the queue on them, and returns the queue and its records.
pub(super) async fn queue(
    args: &WorkArgs,
    settings: Settings,
) -> Result<(Arc<Jobs>, Arc<RecordStore>), String> {
    let blobs = blobs_url(&args.store.data, args.blobs.as_deref())?;
    let store = RecordStore::open(&args.store.database_url()?, settings.rules)
        .await
        .map_err(|error| format!("cannot use the database: {error}"))?;
    let store = Arc::new(store);
    let blobs: Arc<dyn Blobs> = blobs_at(&blobs)
        .map_err(|error| format!("cannot use the place for files: {error}"))?
        .into();
    let records: Arc<dyn JobStore> = Arc::clone(&store) as _;
    let jobs = Arc::new(Jobs::new(settings, records, blobs));
    jobs.recover().await.map_err(|error| error.to_string())?;
    Ok((jobs, store))
}

/// Returns a token that SIGTERM and SIGINT cancel.
pub(super) fn stop_on_signals() -> Result<CancellationToken, String> {
    let stop = CancellationToken::new();
    for kind in [SignalKind::terminate(), SignalKind::interrupt()] {
        let mut signals = signal(kind).map_err(|error| error.to_string())?;
        let stop = stop.clone();
        tokio::spawn(async move {
            signals.recv().await;
            stop.cancel();
        });
    }
    Ok(stop)
}

/// Waits for the end of a stopping process. Returns `None` if it exceeds its time limit.
pub(super) async fn stopped<T>(grace: Duration, all: impl Future<Output = T>) -> Option<T> {
    tracing::info!("stopping");
    tokio::time::timeout(grace + STOP_TIME, all).await.ok()
}
