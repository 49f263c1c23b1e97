//! Assets: files with the places of their outputs.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::list_error::ListError;
use unwrapd_files::document::OutputFormat;

/// An input file and the place of its output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Asset {
    /// Path of the input.
    pub input: PathBuf,
    /// Name in messages and tables: the path within the folder, or as given in the manifest.
    pub name: String,
    /// Path of the output within the output folder.
    pub output: PathBuf,
}

impl Asset {
    /// Creates an asset whose output is named like the input, with the extension of `format`.
    pub(super) fn mirrored(root: &Path, path: &Path, format: OutputFormat) -> Self {
        let is_inside = is_inside(path);
        let within = if is_inside {
            path
        } else {
            Path::new(path.file_name().unwrap_or_default())
        };
        Self {
            input: root.join(path),
            name: path.to_string_lossy().into_owned(),
            output: plain(within).with_extension(format.extension()),
        }
    }
}

/// Returns a path without `.` components.
pub(super) fn plain(path: &Path) -> PathBuf {
    let is_name = |part: &Component| *part != Component::CurDir;
    path.components().filter(is_name).collect()
}

/// Returns whether a relative path stays within its folder.
pub(super) fn is_inside(path: &Path) -> bool {
    let is_plain = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    path.components().all(is_plain)
}

/// Rejects assets that would share an output, and outputs that would replace an input.
pub(super) fn check(assets: &[Asset], to: &Path) -> Result<(), ListError> {
    let mut by_output: BTreeMap<&Path, &Asset> = BTreeMap::new();
    for asset in assets {
        if let Some(first) = by_output.insert(&asset.output, asset) {
            return Err(ListError::SameOutput {
                first: first.name.clone(),
                second: asset.name.clone(),
                output: asset.output.clone(),
            });
        }
    }
    let Ok(folder) = to.canonicalize() else {
        return Ok(());
    };
    for asset in assets {
        let input = asset.input.canonicalize().ok();
        let within = input.as_ref().and_then(|i| i.strip_prefix(&folder).ok());
        if let Some(output) = within.filter(|path| by_output.contains_key(path)) {
            return Err(ListError::ReplacesInput(folder.join(output)));
        }
    }
    Ok(())
}
