//! Assets listed in a file.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;

use super::asset::{self, Asset, is_inside, plain};
use super::list_error::ListError;
use unwrapd_files::document::OutputFormat;

/// Parses a manifest into assets, in its order. Each line is the path of an input, relative to `root`, optionally
/// followed by a tab and the path of its output within the output folder. By default the output is named like the
/// input; for an input outside of `root`, only its file name counts. Empty lines are skipped.
///
/// # Errors
/// Fails if a line is invalid, the manifest is empty, or outputs conflict.
pub fn assets_of(
    name: &str,
    bytes: &[u8],
    root: &Path,
    to: &Path,
    format: OutputFormat,
) -> Result<Vec<Asset>, ListError> {
    let mut assets = Vec::new();
    let mut inputs = BTreeSet::new();
    // Parse the lines, and name the line of an error.
    for (number, line) in (1..).zip(bytes.split(|&byte| byte == b'\n')) {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if line.is_empty() {
            continue;
        }
        let asset = of_line(line, root, format).and_then(|asset| {
            if inputs.insert(asset.input.clone()) {
                Ok(asset)
            } else {
                Err(format!("{} is listed twice", asset.name))
            }
        });
        assets.push(asset.map_err(|cause| ListError::Line {
            manifest: name.to_owned(),
            number,
            cause,
        })?);
    }
    // Check the assets together.
    if assets.is_empty() {
        return Err(ListError::NoAssets(name.to_owned()));
    }
    asset::check(&assets, to)?;
    Ok(assets)
}

fn of_line(line: &[u8], root: &Path, format: OutputFormat) -> Result<Asset, String> {
    let mut fields = line.split(|&byte| byte == b'\t');
    let input = Path::new(OsStr::from_bytes(fields.next().unwrap_or_default()));
    if input.file_name().is_none() {
        return Err("no input file is named".to_owned());
    }
    let mirrored = Asset::mirrored(root, input, format);
    let Some(output) = fields.next() else {
        return Ok(mirrored);
    };
    if fields.next().is_some() {
        return Err("expected INPUT, or INPUT and OUTPUT with a tab between them".to_owned());
    }
    let output = Path::new(OsStr::from_bytes(output));
    let extension = format.extension();
    let is_named = output.extension() == Some(OsStr::new(extension)) && is_inside(output);
    if !is_named {
        let output = output.display();
        return Err(format!(
            "the output {output} must be a relative path without .. that ends in .{extension}"
        ));
    }
    Ok(Asset {
        output: plain(output),
        ..mirrored
    })
}
