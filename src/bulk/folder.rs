//! Listing of the meshes in a folder.

use std::fs;
use std::path::{Path, PathBuf};

use super::asset::{self, Asset};
use super::list_error::ListError;
use unwrapd_files::document::OutputFormat;
use unwrapd_files::io::{Content, Format};

/// Assets of a folder, sorted by path.
#[derive(Debug, Default)]
pub struct Listing {
    /// Assets to process.
    pub assets: Vec<Asset>,
    /// Links to folders, which are not followed because they may form cycles.
    pub links: Vec<PathBuf>,
}

/// Lists the meshes of a folder and its subfolders by their extensions. Skips hidden files and folders, and the
/// output folder.
///
/// # Errors
/// Fails if a folder cannot be read, nothing is found, or outputs conflict.
pub fn assets_in(root: &Path, to: &Path, format: OutputFormat) -> Result<Listing, ListError> {
    let mut walk = Walk {
        root,
        apart: to.canonicalize().ok(),
        files: Vec::new(),
        links: Vec::new(),
    };
    walk.folder(PathBuf::new())?;
    let Walk {
        mut files, links, ..
    } = walk;
    files.sort();
    if files.is_empty() {
        return Err(ListError::NoAssets(root.display().to_string()));
    }
    let assets = files.iter().map(|path| Asset::mirrored(root, path, format));
    let assets: Vec<Asset> = assets.collect();
    asset::check(&assets, to)?;
    Ok(Listing { assets, links })
}

struct Walk<'a> {
    root: &'a Path,
    /// Canonical path of the output folder.
    apart: Option<PathBuf>,
    files: Vec<PathBuf>,
    links: Vec<PathBuf>,
}

impl Walk<'_> {
    /// Visits a folder and everything below it. Paths are relative to the root.
    fn folder(&mut self, first: PathBuf) -> Result<(), ListError> {
        let mut open = vec![first];
        while let Some(folder) = open.pop() {
            let path = if folder.as_os_str().is_empty() {
                self.root.to_path_buf()
            } else {
                self.root.join(&folder)
            };
            // Skip the output folder.
            let is_apart = !folder.as_os_str().is_empty() && path.canonicalize().ok() == self.apart;
            if is_apart && self.apart.is_some() {
                continue;
            }
            let unreadable = |error| ListError::Unreadable {
                path: path.clone(),
                error,
            };
            // Sort the entries into folders to visit, links to report, and meshes.
            for entry in fs::read_dir(&path).map_err(unreadable)? {
                let entry = entry.map_err(unreadable)?;
                let name = entry.file_name();
                if name.as_encoded_bytes().starts_with(b".") {
                    continue;
                }
                let inner = folder.join(&name);
                let kind = entry.file_type().map_err(unreadable)?;
                if kind.is_dir() {
                    open.push(inner);
                } else if kind.is_symlink() && entry.path().is_dir() {
                    self.links.push(entry.path());
                } else if is_mesh(&inner) {
                    self.files.push(inner);
                }
            }
        }
        Ok(())
    }
}

/// Returns whether a file has the extension of a mesh.
fn is_mesh(path: &Path) -> bool {
    let format = Format::of_name(&path.to_string_lossy());
    format.is_some_and(|format| format.holds(Content::Surface))
}
