//! Publication of outputs: moving them into place.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::asset::{Asset, is_inside};
use super::order::Order;
use super::place::Place;
use super::record::Record;
use super::regular::read_regular;
use super::row::Figures;
use super::trouble::{Trouble, unwritten};
use super::worker::Extra;
use unwrapd_api::{Failure, output_file};

/// Quality figures, and the paths and sizes of the written files.
pub(super) type Published = (Figures, Vec<(PathBuf, u64)>);

/// Moves the files made for an asset into place, the main output last.
pub(super) fn published(
    order: &Order,
    asset: &Asset,
    (folder, made): (&Path, &[String]),
    old: Option<&Record>,
) -> Result<Published, Failure> {
    // A record holds for files as it lists them: from here on they change.
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
