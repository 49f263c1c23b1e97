//! Assets: files with the places of their outputs, listed from a folder or a manifest.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Component, Path, PathBuf};

use unwrapd_files::document::OutputFormat;
use unwrapd_files::io::{Content, Format};

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
fn plain(path: &Path) -> PathBuf {
    let names = path.components().filter(|part| *part != Component::CurDir);
    names.collect()
}

/// Returns whether a relative path stays within its folder.
pub(super) fn is_inside(path: &Path) -> bool {
    path.components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}

/// Rejects assets that would share an output, and outputs that would replace an input.
fn check_outputs(assets: &[Asset], to: &Path) -> Result<(), ListError> {
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

// Listing of the meshes in a folder.

/// Assets of a folder, sorted by path.
#[derive(Debug, Default)]
pub struct FolderListing {
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
pub fn assets_in(root: &Path, to: &Path, format: OutputFormat) -> Result<FolderListing, ListError> {
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
    check_outputs(&assets, to)?;
    Ok(FolderListing { assets, links })
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
            // Sort the entries into folders to visit, links to report, and meshes.
            for entry in fs::read_dir(&path).map_err(|e| unreadable(&path, e))? {
                let entry = entry.map_err(|e| unreadable(&path, e))?;
                let name = entry.file_name();
                if name.as_encoded_bytes().starts_with(b".") {
                    continue;
                }
                let inner = folder.join(&name);
                let kind = entry.file_type().map_err(|e| unreadable(&path, e))?;
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

fn unreadable(path: &Path, error: std::io::Error) -> ListError {
    ListError::Unreadable {
        path: path.to_path_buf(),
        error,
    }
}

/// Returns whether a file has the extension of a mesh.
fn is_mesh(path: &Path) -> bool {
    let format = Format::of_name(&path.to_string_lossy());
    format.is_some_and(|format| format.holds(Content::Surface))
}

// Assets listed in a file.

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
    check_outputs(&assets, to)?;
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

// Errors of asset lists.

/// Reason why the list of assets is invalid.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// A folder or a manifest cannot be read.
    #[error("{}: {error}", path.display())]
    Unreadable {
        /// Path of the folder or manifest.
        path: PathBuf,
        /// Cause.
        error: std::io::Error,
    },
    /// There is nothing to do.
    #[error("{0} names no mesh: .glb, .gltf, .obj, .off, .ply or .stl")]
    NoAssets(String),
    /// A line of a manifest is invalid.
    #[error("{manifest}, line {number}: {cause}")]
    Line {
        /// Name of the manifest.
        manifest: String,
        /// Number of the line, from 1.
        number: usize,
        /// Cause.
        cause: String,
    },
    /// Two assets have the same output.
    #[error(
        "{first} and {second} would both be written to {}: name their outputs in a manifest",
        output.display()
    )]
    SameOutput {
        /// The first asset.
        first: String,
        /// The second asset.
        second: String,
        /// Their output, within the output folder.
        output: PathBuf,
    },
    /// An output would replace an input.
    #[error("{} is an input and would be replaced: choose another output directory", .0.display())]
    ReplacesInput(PathBuf),
}

impl ListError {
    /// Returns the exit status of the command line: 2 usage, 3 unusable input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unreadable { .. } | Self::NoAssets(_) | Self::Line { .. } => 3,
            Self::SameOutput { .. } | Self::ReplacesInput(_) => 2,
        }
    }
}
