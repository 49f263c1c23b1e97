//! Input files: each is opened and read once, so it may be a pipe; `-` is standard input.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use crate::bulk::{MOST_BYTES, read_bounded, read_regular};
use unwrapd_files::document::{Upload, with_references};

/// A file that has UVs.
#[derive(clap::Args)]
pub(super) struct Mapped {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
}

/// Returns whether a name stands for standard input or output.
pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a file or standard input.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, Failure> {
    let read = if is_standard(path) {
        read_bounded(io::stdin(), MOST_BYTES)
    } else {
        read_named(path)
    };
    let name = if is_standard(path) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    };
    read.map_err(|error| Failure::input(format!("{name}: {error}")))
}

/// Reads a file named on the command line: it may be a pipe, but not a device, which may never end.
fn read_named(path: &Path) -> io::Result<Vec<u8>> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_fifo() || kind.is_socket() {
        return read_bounded(fs::File::open(path)?, MOST_BYTES);
    }
    read_regular(path)
}

/// Reads a file and the files that it references by relative URI.
pub(super) fn read_upload(path: &Path) -> Result<Upload, Failure> {
    let (upload, folder) = (upload(path, read_file(path)?, []), folder(path));
    Ok(with_references(upload, |reference| {
        read_regular(&folder.join(reference)).ok()
    }))
}

/// Creates an upload from a file that was read and from those of its references that exist.
pub(super) fn upload(
    path: &Path,
    bytes: Vec<u8>,
    references: impl IntoIterator<Item = String>,
) -> Upload {
    let folder = folder(path);
    let mut resources = BTreeMap::new();
    for reference in references {
        if let Ok(content) = read_regular(&folder.join(&reference)) {
            resources.insert(reference, content);
        }
    }
    let name = if is_standard(path) {
        None
    } else {
        path.file_name()
    };
    Upload {
        name: name.unwrap_or_default().to_string_lossy().into_owned(),
        bytes,
        resources,
    }
}

/// Returns the folder to which references of a file are relative; the current one for a pipe.
pub(super) fn folder(path: &Path) -> PathBuf {
    let is_file = !is_standard(path) && path.is_file();
    let folder = if is_file { path.parent() } else { None };
    folder.unwrap_or(Path::new("")).to_path_buf()
}
