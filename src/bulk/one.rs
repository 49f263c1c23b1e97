//! One asset of a run: read, looked up, processed, published, recorded.

use std::fs;
use std::io;
use std::path::Path;
use std::time::Instant;

use tokio::task::block_in_place;

use super::asset::Asset;
use super::order::{Fate, Order};
use super::publish::{Published, published};
use super::record::Record;
use super::regular::read_regular;
use super::row::{Row, Status};
use super::trouble::{Trouble, unwritten};
use super::worker::{Task, Worker};
use unwrapd_api::Failure;
use unwrapd_files::document::{Upload, with_references};

/// Processes an asset unless an earlier run did. Returns its row.
pub(super) async fn asset<W: Worker>(order: &Order, worker: &W, index: usize) -> (Row, Fate) {
    let (begin, asset) = (Instant::now(), &order.assets[index]);
    let row = |seconds, status| Row::new(asset, seconds, status);
    // Read the input and look for a record of the same work.
    let upload = match block_in_place(|| read(asset)) {
        Ok(upload) => upload,
        Err(error) => {
            let failure = Trouble::InputUnreadable.with(error.to_string());
            return (row(0.0, failure.into()), Fate::Done);
        }
    };
    let digest = block_in_place(|| order.recipe.with(&upload));
    let time_limit = worker.time_limit().map(|limit| limit.as_secs_f64());
    let old = Record::load(&order.place, asset);
    let same = old.as_ref().filter(|old| old.digest == digest);
    if let Some(same) = same.filter(|same| same.is_whole(&order.place))
        && !(same.may_pass() || same.was_cut_short(time_limit))
        && !(order.retries && same.has_failed())
    {
        // The record may have another name of the input.
        let Row {
            seconds, status, ..
        } = same.row.clone();
        return (row(seconds, status), Fate::Kept);
    }
    // Do the work, and record how it ended.
    let attempt = same.map_or(0, Record::next_attempt);
    let work = (&upload, digest.as_str(), attempt);
    let made = done(order, worker, index, work, old.as_ref()).await;
    let (status, files) = match made {
        Ok((figures, files)) => (Status::Written(figures), files),
        Err(failure) => (failure.into(), Vec::new()),
    };
    let mut record = Record {
        digest,
        attempt,
        time_limit,
        files,
        row: row(begin.elapsed().as_secs_f64(), status),
    };
    if let Err(error) = block_in_place(|| settle(order, asset, &record, old.as_ref())) {
        record.row.status = unwritten(&error).into();
    }
    (record.row, Fate::Done)
}

/// Does the work on an asset and publishes its outputs.
async fn done<W: Worker>(
    order: &Order,
    worker: &W,
    index: usize,
    (upload, digest, attempt): (&Upload, &str, u32),
    old: Option<&Record>,
) -> Result<Published, Failure> {
    let folder = order.scratch.folder(index);
    let folder = folder.map_err(|error| unwritten(&error))?;
    let task = Task {
        upload,
        digest,
        attempt,
        folder: &folder,
    };
    let made = worker.work(task).await.and_then(|made| {
        let asset = &order.assets[index];
        block_in_place(|| published(order, asset, (&folder, &made), old))
    });
    // What stays there takes space only until the end of the run.
    let _ = fs::remove_dir_all(&folder);
    made
}

/// Records how an asset ended. If it failed, removes an output of another input or other options.
fn settle(order: &Order, asset: &Asset, record: &Record, old: Option<&Record>) -> io::Result<()> {
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
