//! A run over assets: what is recorded is kept, the rest is done, several at once.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use tokio::task::{JoinSet, block_in_place};

use super::asset::{Asset, is_inside};
use super::digest::Recipe;
use super::place::Place;
use super::record::Record;
use super::row::{Figures, Row, Status};
use super::scratch::Scratch;
use super::worker::{Extra, Task, Worker};
use crate::document::Upload;
use crate::jobs::{Failure, OutputFile, output_file};
use crate::pipeline::Options;

/// What a run does.
pub struct Order {
    /// The assets, of this shard only.
    pub assets: Vec<Asset>,
    /// Where outputs go.
    pub place: Place,
    /// Where they are made.
    pub scratch: Scratch,
    /// What is written beside outputs.
    pub extras: Vec<Extra>,
    /// Whether assets that failed for good are done again.
    pub retries: bool,
    /// Assets in work at once.
    pub concurrency: usize,
    recipe: Recipe,
}

/// How a run came to a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// An earlier run did the work.
    Kept,
    /// This one did it.
    Done,
}

/// Told of every row as it comes.
pub type Seen<'a> = &'a mut (dyn FnMut(&Row, Fate) + Send);

impl Order {
    /// One asset at a time, by a worker of this version.
    ///
    /// # Errors
    /// If the options cannot be written as JSON.
    pub fn new(
        assets: Vec<Asset>,
        place: Place,
        version: &str,
        options: &Options,
        extras: Vec<Extra>,
    ) -> io::Result<Self> {
        Ok(Self {
            assets,
            place,
            scratch: Scratch::new()?,
            recipe: Recipe::new(version, options, &extras)?,
            extras,
            retries: false,
            concurrency: 1,
        })
    }
}

/// Does what an order asks for; the rows are in the order of the assets. Dropped before its end, it
/// stops all work.
pub async fn run<W: Worker>(order: Order, worker: W, seen: Seen<'_>) -> Vec<Row> {
    let (order, worker) = (Arc::new(order), Arc::new(worker));
    let mut rows: Vec<Option<Row>> = vec![None; order.assets.len()];
    let mut waiting = 0..order.assets.len();
    let mut running = JoinSet::new();
    let mut places = HashMap::new();
    loop {
        while running.len() < order.concurrency.max(1)
            && let Some(index) = waiting.next()
        {
            let (order, worker) = (Arc::clone(&order), Arc::clone(&worker));
            let handle = running.spawn(async move { asset(&order, &*worker, index).await });
            places.insert(handle.id(), index);
        }
        let Some(ended) = running.join_next_with_id().await else {
            break;
        };
        let (id, (row, fate)) = ended.unwrap_or_else(|error| {
            let row = order.row(places[&error.id()], 0.0, broken(&error).into());
            (error.id(), (row, Fate::Done))
        });
        seen(&row, fate);
        rows[places[&id]] = Some(row);
    }
    rows.into_iter().flatten().collect()
}

/// The rows that earlier runs have recorded.
pub fn recorded(assets: &[Asset], place: &Place) -> Vec<Row> {
    let row = |asset| {
        let record = Record::load(place, asset).filter(|record| record.is_whole(place));
        record.map_or_else(
            || Row::new(asset, 0.0, Status::Missing),
            |record| record.row,
        )
    };
    assets.iter().map(row).collect()
}

/// A mistake of this program that one asset brought to light.
fn broken(error: &tokio::task::JoinError) -> Failure {
    Failure::new("crashed", format!("{error}, which is a bug"))
}

async fn asset<W: Worker>(order: &Order, worker: &W, index: usize) -> (Row, Fate) {
    let (begin, asset) = (Instant::now(), &order.assets[index]);
    let upload = match block_in_place(|| read(asset)) {
        Ok(upload) => upload,
        Err(error) => {
            let failure = Failure::new("input_unreadable", error.to_string());
            return (order.row(index, 0.0, failure.into()), Fate::Done);
        }
    };
    let digest = block_in_place(|| order.recipe.with(&upload));
    let old = Record::load(&order.place, asset);
    let old_files = old.as_ref().map_or(Vec::new(), |old| old.files.clone());
    let same = old.filter(|old| old.digest == digest && old.is_whole(&order.place));
    let attempt = same.as_ref().map_or(0, Record::next_attempt);
    if let Some(old) = same
        && !(old.may_pass() || (order.retries && old.has_failed()))
    {
        // It may have been recorded under another name.
        return (
            order.row(index, old.row.seconds, old.row.status),
            Fate::Kept,
        );
    }
    let made = match order.scratch.folder(index) {
        Ok(folder) => {
            let task = Task {
                upload: &upload,
                digest: &digest,
                attempt,
                folder: &folder,
            };
            let made = worker.work(task).await;
            let made = made.and_then(|made| {
                block_in_place(|| publish(order, asset, (&folder, &made), &old_files))
            });
            // What stays there takes space only until the end of the run.
            let _ = fs::remove_dir_all(&folder);
            made
        }
        Err(error) => Err(unwritten(&error)),
    };
    let (status, files) = match made {
        Ok((figures, files)) => (Status::Written(figures), files),
        Err(failure) => (failure.into(), Vec::new()),
    };
    let mut record = Record {
        digest,
        attempt,
        files,
        row: order.row(index, begin.elapsed().as_secs_f64(), status),
    };
    if let Err(error) = block_in_place(|| record.store(&order.place, asset)) {
        record.row.status = unwritten(&error).into();
    }
    (record.row, Fate::Done)
}

impl Order {
    fn row(&self, index: usize, seconds: f64, status: Status) -> Row {
        Row::new(&self.assets[index], seconds, status)
    }
}

/// The files of an asset. The main one is named like the output, since files that belong to an
/// output are named after its input.
fn read(asset: &Asset) -> io::Result<Upload> {
    let bytes = fs::read(&asset.input)?;
    let stem = asset.output.file_stem().unwrap_or_default();
    let mut name = Path::new(stem).to_path_buf();
    if let Some(extension) = asset.input.extension() {
        name.as_mut_os_string().push(".");
        name.as_mut_os_string().push(extension);
    }
    let folder = asset.input.parent().unwrap_or(Path::new(""));
    let upload = Upload::single(name.to_string_lossy(), bytes);
    Ok(upload.with_references(|reference| fs::read(folder.join(reference)).ok()))
}

type Published = (Figures, Vec<(PathBuf, u64)>);

/// Moves what was made to where it belongs, the main output last.
fn publish(
    order: &Order,
    asset: &Asset,
    (folder, made): (&Path, &[OutputFile]),
    old: &[(PathBuf, u64)],
) -> Result<Published, Failure> {
    let mut figures = None;
    let mut files = Vec::new();
    for (index, file) in made.iter().enumerate().rev() {
        let content = fs::read(folder.join(output_file(index))).map_err(|e| unwritten(&e))?;
        if file.role == Extra::Report.role() {
            let read = Figures::of_report(&content);
            figures = Some(read.map_err(|e| Failure::new("internal_error", e.to_string()))?);
        }
        let Some(path) = destination(order, asset, &file.role)? else {
            continue;
        };
        let is_own = is_named_like(&path, &asset.output) || old.iter().any(|(old, _)| *old == path);
        let whole = order.place.path(&path);
        if !is_own && fs::read(&whole).is_ok_and(|there| there != content) {
            let detail = format!("{} is there and belongs to something else", path.display());
            return Err(Failure::new("output_conflict", detail));
        }
        let written = order.place.write(&whole, &content);
        written.map_err(|error| unwritten(&error))?;
        files.push((path, content.len() as u64));
    }
    let figures = figures.ok_or_else(|| Failure::new("internal_error", "there is no report"))?;
    Ok((figures, files))
}

/// Whether a file is named after an output, so that no other asset has it.
fn is_named_like(path: &Path, output: &Path) -> bool {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_os_string();
    let stem = output.file_stem().unwrap_or_default().as_encoded_bytes();
    path == output || name(path).as_encoded_bytes().starts_with(stem)
}

/// Where a file belongs within the output folder; `None` if nobody asked for it.
fn destination(order: &Order, asset: &Asset, role: &str) -> Result<Option<PathBuf>, Failure> {
    if role == "result" {
        return Ok(Some(asset.output.clone()));
    }
    if let Some(name) = role.strip_prefix("files/") {
        if !is_inside(Path::new(name)) {
            let detail = format!("{name} is outside the folder of the output");
            return Err(Failure::new("output_unwritable", detail));
        }
        return Ok(Some(asset.output.with_file_name(name)));
    }
    let mut extras = order.extras.iter();
    let extra = extras.find(|extra| extra.role() == role);
    Ok(extra.map(|extra| asset.output.with_extension(extra.suffix())))
}

fn unwritten(error: &io::Error) -> Failure {
    let code = match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "storage_full",
        _ => "output_unwritable",
    };
    Failure::new(code, error.to_string())
}
