//! One asset of a run: read, looked up, processed, published, recorded.

use super::asset::{Asset, is_inside};
use super::order::{Fate, Order};
use super::place::Place;
use super::record::Record;
use super::regular::read_regular;
use super::row::{Figures, Row, Status};
use super::trouble::{Trouble, unwritten};
use super::worker::{Extra, Task, Worker};
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{fs, io};
use tokio::task::block_in_place;
use unwrapd_api::{Failure, output_file};
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
        // The record may be from a run in which the input had another name.
        let Row {
            seconds, status, ..
        } = same.row.clone();
        return (row(seconds, status), Fate::Kept);
    }
    // Do the work, and record how it ended.
    let attempt = same.map_or(0, Record::next_attempt);
    let old = old.as_ref();
    let made = done(order, worker, index, &upload, &digest, attempt, old).await;
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
    if let Err(error) = block_in_place(|| settle(order, asset, &record, old)) {
        record.row.status = unwritten(&error).into();
    }
    (record.row, Fate::Done)
}

/// Does the work on an asset and publishes its outputs.
async fn done<W: Worker>(
    order: &Order,
    worker: &W,
    index: usize,
    upload: &Upload,
    digest: &str,
    attempt: u32,
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
        block_in_place(|| published(order, asset, &folder, &made, old))
    });
    // The folder is removed at the end of the run anyway.
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

// Publication of outputs: moving them into place.

/// Quality figures, and the paths and sizes of the written files.
type Published = (Figures, Vec<(PathBuf, u64)>);

/// Moves the files made for an asset into place, the main output last.
fn published(
    order: &Order,
    asset: &Asset,
    folder: &Path,
    made: &[String],
    old: Option<&Record>,
) -> Result<Published, Failure> {
    // Remove the record first: it vouches for files that change from here on.
    let forgotten = order.place.remove(&Place::record(asset));
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
fn put(place: &Place, path: &Path, content: &[u8], is_own: bool) -> Result<(), Failure> {
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
    let name = |path: &Path| path.file_name().unwrap_or_default().to_os_string();
    let stem = output.file_stem().unwrap_or_default().as_encoded_bytes();
    path == output || name(path).as_encoded_bytes().starts_with(stem)
}

/// Returns the path of a file within the output folder; `None` if it was not requested.
fn destination(order: &Order, asset: &Asset, role: &str) -> Result<Option<PathBuf>, Failure> {
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
