//! A run over assets: keeps recorded ones and processes the rest concurrently.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::pin::pin;
use std::sync::Arc;
use std::time::Instant;

use tokio::task::{JoinError, JoinSet, block_in_place};

use super::assets::{Asset, is_inside};
use super::place::{OutputFolder, read_regular};
use super::record::{AssetRecord, Trouble, unwritten};
use super::rows::{AssetStatus, Figures, SummaryRow};
use super::worker::{AssetTask, Extra, Worker};
use unwrapd_api::{Failure, output_file};
use unwrapd_files::document::{Upload, with_references};
use unwrapd_pipeline::{Options, Workers};
use unwrapd_server::jobs::Digest;

/// Callback for every row as it is produced.
pub type Seen<'a> = &'a mut (dyn FnMut(&SummaryRow, Fate) + Send);

/// Runs an order. Returns the rows in the order of the assets, or `None` if `stop` completed first: then all work has
/// stopped, and unfinished work is not recorded.
pub async fn run<W: Worker>(
    order: RunOrder,
    worker: W,
    seen: Seen<'_>,
    stop: impl Future<Output = ()>,
) -> Option<Vec<SummaryRow>> {
    let mut stop = pin!(stop);
    let (order, worker) = (Arc::new(order), Arc::new(worker));
    let mut rows: Vec<Option<SummaryRow>> = vec![None; order.assets.len()];
    let mut waiting = 0..order.assets.len();
    let mut running = JoinSet::new();
    let mut places = HashMap::new();
    loop {
        // Start assets while there are free slots.
        while running.len() < order.concurrency.max(1)
            && let Some(index) = waiting.next()
        {
            let (order, worker) = (Arc::clone(&order), Arc::clone(&worker));
            let handle = running.spawn(async move { process(&order, &*worker, index).await });
            places.insert(handle.id(), index);
        }
        // Wait for the next asset, or for the stop.
        let ended = tokio::select! {
            ended = running.join_next_with_id() => ended,
            () = &mut stop => {
                running.shutdown().await;
                return None;
            }
        };
        let Some(ended) = ended else {
            break;
        };
        // Turn a panic into a row, and report the row.
        let (id, (row, fate)) = ended.unwrap_or_else(|error| {
            let asset = &order.assets[places[&error.id()]];
            let row = SummaryRow::new(asset, 0.0, broken(&error).into());
            (error.id(), (row, Fate::Done))
        });
        seen(&row, fate);
        rows[places[&id]] = Some(row);
    }
    Some(rows.into_iter().flatten().collect())
}

/// Returns the rows that earlier runs have recorded.
pub fn recorded(assets: &[Asset], place: &OutputFolder) -> Vec<SummaryRow> {
    let mut rows = Vec::new();
    for asset in assets {
        let record = AssetRecord::load(place, asset).filter(|record| record.is_whole(place));
        rows.push(match record {
            Some(AssetRecord { row, .. }) => SummaryRow::new(asset, row.seconds, row.status),
            None => SummaryRow::new(asset, 0.0, AssetStatus::Missing),
        });
    }
    rows
}

/// Returns the failure of a task that panicked, which is a bug of this program.
fn broken(error: &JoinError) -> Failure {
    Failure::new("crashed", format!("{error}, which is a bug"))
}

// One asset of a run: read, looked up, processed, published, recorded.

/// Processes an asset unless an earlier run did. Returns its row.
async fn process<W: Worker>(order: &RunOrder, worker: &W, index: usize) -> (SummaryRow, Fate) {
    let (begin, asset) = (Instant::now(), &order.assets[index]);
    // Read the input and look for a record of the same work.
    let upload = match block_in_place(|| read(asset)) {
        Ok(upload) => upload,
        Err(error) => {
            let failure = Trouble::InputUnreadable.with(error.to_string());
            return (SummaryRow::new(asset, 0.0, failure.into()), Fate::Done);
        }
    };
    let digest = block_in_place(|| order.recipe.with(&upload));
    let time_limit = worker.time_limit().map(|limit| limit.as_secs_f64());
    let old = AssetRecord::load(&order.place, asset);
    let same = old.as_ref().filter(|old| old.digest == digest);
    if let Some(same) = same.filter(|same| same.is_whole(&order.place))
        && !(same.may_pass() || same.was_cut_short(time_limit))
        && !(order.retries && same.has_failed())
    {
        // The record may be from a run in which the input had another name.
        let SummaryRow {
            seconds, status, ..
        } = same.row.clone();
        return (SummaryRow::new(asset, seconds, status), Fate::Kept);
    }
    // Do the work, and record how it ended.
    let attempt = same.map_or(0, AssetRecord::next_attempt);
    let old = old.as_ref();
    let work = AssetWork {
        order,
        index,
        upload: &upload,
        digest: &digest,
        attempt,
        old,
    };
    let made = work.publish(worker).await;
    let (status, files) = match made {
        Ok((figures, files)) => (AssetStatus::Written(figures), files),
        Err(failure) => (failure.into(), Vec::new()),
    };
    let mut record = AssetRecord {
        digest,
        attempt,
        time_limit,
        files,
        row: SummaryRow::new(asset, begin.elapsed().as_secs_f64(), status),
    };
    if let Err(error) = block_in_place(|| settle(order, asset, &record, old)) {
        record.row.status = unwritten(&error).into();
    }
    (record.row, Fate::Done)
}

/// Work on an asset that no earlier run did.
struct AssetWork<'a> {
    order: &'a RunOrder,
    /// Index of the asset.
    index: usize,
    upload: &'a Upload,
    /// Digest of input, options and version.
    digest: &'a str,
    /// Number of earlier failures with this digest.
    attempt: u32,
    /// Record of an earlier run, of whatever input.
    old: Option<&'a AssetRecord>,
}

impl AssetWork<'_> {
    /// Does the work and publishes its outputs.
    async fn publish<W: Worker>(&self, worker: &W) -> Result<Published, Failure> {
        let folder = self.order.scratch.folder(self.index);
        let folder = folder.map_err(|error| unwritten(&error))?;
        let task = AssetTask {
            upload: self.upload,
            digest: self.digest,
            attempt: self.attempt,
            folder: &folder,
        };
        let made = worker.work(task).await.and_then(|made| {
            let asset = &self.order.assets[self.index];
            block_in_place(|| published(self.order, asset, &folder, &made, self.old))
        });
        // The folder is removed at the end of the run anyway.
        let _ = fs::remove_dir_all(&folder);
        made
    }
}

/// Records how an asset ended. If it failed, removes an output of another input or other options.
fn settle(
    order: &RunOrder,
    asset: &Asset,
    record: &AssetRecord,
    old: Option<&AssetRecord>,
) -> io::Result<()> {
    let is_outdated = old.is_some_and(|old| old.digest != record.digest && !old.has_failed());
    if is_outdated && record.has_failed() {
        order.place.remove(&asset.output)?;
    }
    record.store(&order.place, asset)
}

/// Reads the files of an asset. The main file gets the stem of the output, because files that belong to an output are
/// named after its input.
fn read(asset: &Asset) -> io::Result<Upload> {
    let bytes = read_regular(&asset.input)?;
    let stem = asset.output.file_stem().unwrap_or_default();
    let mut name = Path::new(stem).to_path_buf();
    if let Some(extension) = asset.input.extension() {
        name.as_mut_os_string().push(".");
        name.as_mut_os_string().push(extension);
    }
    let folder = asset.input.parent().unwrap_or(Path::new(""));
    let upload = Upload::single(name.to_string_lossy(), bytes);
    Ok(with_references(upload, |reference| {
        read_regular(&folder.join(reference)).ok()
    }))
}

// Publication of outputs: moving them into place.

/// Quality figures, and the paths and sizes of the written files.
type Published = (Figures, Vec<(PathBuf, u64)>);

/// Moves the files made for an asset into place, the main output last.
fn published(
    order: &RunOrder,
    asset: &Asset,
    folder: &Path,
    made: &[String],
    old: Option<&AssetRecord>,
) -> Result<Published, Failure> {
    // Remove the record first: it vouches for files that change from here on.
    let forgotten = order.place.remove(&OutputFolder::record(asset));
    forgotten.map_err(|error| unwritten(&error))?;
    let mut figures = None;
    let mut files = Vec::new();
    // The main output has index 0, so it comes last.
    for (index, role) in made.iter().enumerate().rev() {
        let content = fs::read(folder.join(output_file(index))).map_err(|e| unwritten(&e))?;
        if role == Extra::Report.role() {
            let read = Figures::of_report(&content);
            figures = Some(read.map_err(|e| Failure::new("internal_error", e.to_string()))?);
        }
        let Some(path) = destination(order, asset, role)? else {
            continue;
        };
        let is_own = is_named_like(&path, &asset.output)
            || old.is_some_and(|old| old.files.iter().any(|(old, _)| *old == path));
        put(&order.place, &path, &content, is_own)?;
        files.push((path, content.len() as u64));
    }
    // The report is among the files of every worker.
    let figures = figures.ok_or_else(|| Failure::new("internal_error", "there is no report"))?;
    Ok((figures, files))
}

/// Writes a file, unless it already has this content. A file with different content may belong to another asset:
/// several outputs can share a picture.
fn put(place: &OutputFolder, path: &Path, content: &[u8], is_own: bool) -> Result<(), Failure> {
    match read_regular(&place.path(path)) {
        Ok(there) if there == content => Ok(()),
        Ok(_) if !is_own => {
            let detail = format!("{} is there and belongs to something else", path.display());
            Err(Trouble::OutputConflict.with(detail))
        }
        Err(error) if !is_own && error.kind() == io::ErrorKind::InvalidInput => {
            let detail = format!("{}: {error}", path.display());
            Err(Trouble::OutputConflict.with(detail))
        }
        _ => place
            .write(path, content)
            .map_err(|error| unwritten(&error)),
    }
}

/// Returns whether a file is named after an output, so that no other asset has it.
fn is_named_like(path: &Path, output: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().as_encoded_bytes();
    let stem = output.file_stem().unwrap_or_default().as_encoded_bytes();
    path == output || name.starts_with(stem)
}

/// Returns the path of a file within the output folder; `None` if it was not requested.
fn destination(order: &RunOrder, asset: &Asset, role: &str) -> Result<Option<PathBuf>, Failure> {
    if role == "result" {
        return Ok(Some(asset.output.clone()));
    }
    if let Some(name) = role.strip_prefix("files/") {
        if !is_inside(Path::new(name)) {
            let detail = format!("{name} is outside the folder of the output");
            return Err(Trouble::OutputUnwritable.with(detail));
        }
        return Ok(Some(asset.output.with_file_name(name)));
    }
    let mut extras = order.extras.iter();
    let extra = extras.find(|extra| extra.role() == role);
    Ok(extra.map(|extra| asset.output.with_extension(extra.suffix())))
}

// Settings of a run.

/// Settings of a run.
pub struct RunOrder {
    /// Assets of this shard.
    pub assets: Vec<Asset>,
    /// Output folder.
    pub place: OutputFolder,
    /// Folder for temporary files.
    pub scratch: RunScratch,
    /// Files to write beside outputs.
    pub extras: Vec<Extra>,
    /// Set to retry assets that failed permanently.
    pub retries: bool,
    /// Maximum number of assets in progress.
    pub concurrency: usize,
    pub(super) recipe: Recipe,
}

/// Origin of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// An earlier run did the work.
    Kept,
    /// This run did the work.
    Done,
}

impl RunOrder {
    /// Creates a run of one asset at a time, by a worker of this version.
    ///
    /// # Errors
    /// Fails if the scratch folder cannot be created, or the options cannot be written as JSON.
    pub fn new(
        assets: Vec<Asset>,
        place: OutputFolder,
        version: &str,
        options: &Options,
        extras: Vec<Extra>,
    ) -> io::Result<Self> {
        Ok(Self {
            assets,
            place,
            scratch: RunScratch::new()?,
            recipe: Recipe::new(version, options, &extras)?,
            extras,
            retries: false,
            concurrency: 1,
        })
    }
}

// Digests of everything that determines an output.

/// Digest of the settings shared by all assets of a run.
#[derive(Clone, Debug)]
pub(super) struct Recipe(Digest);

impl Recipe {
    /// Creates the digest of a worker's version, the options, and the extra files. The number of threads does not
    /// count, because outputs do not depend on it.
    pub fn new(version: &str, options: &Options, extras: &[Extra]) -> serde_json::Result<Self> {
        let options = Options {
            workers: Workers::default(),
            ..options.clone()
        };
        let mut digest = Digest::default();
        digest.add(version.as_bytes());
        digest.add(&serde_json::to_vec(&options)?);
        for extra in extras {
            digest.add(extra.suffix().as_bytes());
        }
        Ok(Self(digest))
    }

    /// Returns the digest of an asset.
    pub fn with(&self, upload: &Upload) -> String {
        let mut digest = self.0.clone();
        digest.add(upload.name.as_bytes());
        digest.add(&upload.bytes);
        for (name, bytes) in &upload.resources {
            digest.add(name.as_bytes());
            digest.add(bytes);
        }
        digest.finish()
    }
}

// Temporary folder on a local disk.

/// Prefix of the folders of all processes, and the name of the lock file in each.
const PREFIX: &str = "unwrapd-bulk-";
const LOCK: &str = "lock";

/// A folder of this process in the temporary folder (`TMPDIR`). It is removed on drop.
#[derive(Debug)]
pub struct RunScratch {
    path: PathBuf,
    /// Lock that the system releases when the process ends.
    _lock: File,
}

impl RunScratch {
    /// Creates a folder, and removes those of killed processes.
    ///
    /// # Errors
    /// Fails if it cannot be created.
    pub fn new() -> io::Result<Self> {
        let all = std::env::temp_dir();
        for entry in fs::read_dir(&all)?.filter_map(Result::ok) {
            let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX);
            if is_ours && let Some(_lock) = lock_of_abandoned(&entry.path()) {
                // Another process may be removing it too.
                let _ = fs::remove_dir_all(entry.path());
            }
        }
        loop {
            let path = all.join(format!("{PREFIX}{}", uuid::Uuid::now_v7()));
            fs::create_dir(&path)?;
            let lock = File::create(path.join(LOCK))?;
            lock.lock()?;
            // Until it was locked, another process may have taken the folder for an abandoned one.
            if path.join(LOCK).exists() {
                return Ok(Self { path, _lock: lock });
            }
        }
    }

    /// Creates an empty subfolder.
    ///
    /// # Errors
    /// Fails if there is one of that name, or if it cannot be created.
    pub fn folder(&self, name: usize) -> io::Result<PathBuf> {
        let path = self.path.join(name.to_string());
        fs::create_dir(&path)?;
        Ok(path)
    }
}

/// Returns the lock of a folder whose process has ended, which must be held until the folder is removed. A folder without a lock file is
/// just being made.
fn lock_of_abandoned(folder: &Path) -> Option<File> {
    let lock = File::open(folder.join(LOCK)).ok()?;
    lock.try_lock().ok()?;
    Some(lock)
}

impl Drop for RunScratch {
    fn drop(&mut self) {
        // A later process removes what is left.
        let _ = fs::remove_dir_all(&self.path);
    }
}
