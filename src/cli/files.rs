//! Files in and out of the command line: an input with what it references, outputs that are never half-written.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::failure::Failure;
use crate::document::{OutputFormat, Upload, Warning};

/// Reads a file.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|error| Failure::input(format!("{}: {error}", path.display())))
}

/// Reads a file and the files beside it that it references by relative URI. A missing one is left to the document,
/// which knows whether it is needed.
pub(super) fn read_upload(path: &Path) -> Result<Upload, Failure> {
    let mut upload = read_upload_with(path, [])?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut tried = BTreeSet::new();
    // What is found may refer to more.
    while let new = (upload.references())
        .difference(&tried)
        .cloned()
        .collect::<Vec<_>>()
        && !new.is_empty()
    {
        for reference in new {
            if let Ok(content) = fs::read(folder.join(&reference)) {
                upload.resources.insert(reference.clone(), content);
            }
            tried.insert(reference);
        }
    }
    Ok(upload)
}

/// Reads a file and those of the files that it references that are there.
pub(super) fn read_upload_with(
    path: &Path,
    references: impl IntoIterator<Item = String>,
) -> Result<Upload, Failure> {
    let bytes = read_file(path)?;
    let name = path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut resources = BTreeMap::new();
    for reference in references {
        if let Ok(content) = fs::read(folder.join(&reference)) {
            resources.insert(reference, content);
        }
    }
    Ok(Upload {
        name,
        bytes,
        resources,
    })
}

/// Writes the files of a result: the main one at `path`, the others beside it. Each is written whole under another
/// name and then moved into place, the main one last, so that an interruption leaves no half-written file.
pub(super) fn write_outputs(path: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let targets: Vec<PathBuf> = files
        .iter()
        .enumerate()
        .map(|(i, (name, _))| {
            if i == 0 {
                path.to_path_buf()
            } else {
                folder.join(name)
            }
        })
        .collect();
    for (target, (_, bytes)) in targets.iter().zip(files).rev() {
        write_atomically(target, bytes)?;
    }
    Ok(())
}

/// Writes a whole file or none.
pub(super) fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let write = || -> io::Result<()> {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(&part, bytes)?;
        fs::rename(&part, path)
    };
    write().map_err(|error| {
        // The part may not exist; the first error is the one to tell.
        let _ = fs::remove_file(&part);
        Failure::other(format!("{}: {error}", path.display()))
    })
}

/// Prints a line on standard output. That a reader has gone away, as `head` does, is no failure.
pub(super) fn say(line: impl Display) {
    let _ = writeln!(io::stdout(), "{line}");
}

/// Prints warnings on standard error, a line each.
pub(super) fn warn(warnings: &[Warning]) {
    for Warning { message, .. } in warnings {
        let _ = writeln!(io::stderr(), "warning: {message}");
    }
}

/// Indented JSON.
pub(super) fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, Failure> {
    serde_json::to_vec_pretty(value).map_err(|error| Failure::other(error.to_string()))
}

/// The format of a mesh to write, by the extension of its name.
pub(super) fn output_format(path: &Path) -> Result<OutputFormat, Failure> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("glb") => Ok(OutputFormat::Glb),
        Some("gltf") => Ok(OutputFormat::Gltf),
        Some("obj") => Ok(OutputFormat::Obj),
        _ => Err(Failure::usage(format!(
            "{}: OUT must end in .glb, .gltf or .obj",
            path.display()
        ))),
    }
}
