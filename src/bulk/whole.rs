//! Files that are complete or absent, even after a system crash.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Writes a file as `part` and moves it to `path`. Syncs the content before the name, and the name before returning.
///
/// # Errors
/// Fails if it cannot be written; the file at `path` is then unchanged.
pub(super) fn write_whole(path: &Path, part: &Path, content: &[u8]) -> io::Result<()> {
    let written = written(part, content).and_then(|()| fs::rename(part, path));
    if let Err(error) = written {
        // The first error is the one to tell.
        let _ = fs::remove_file(part);
        return Err(error);
    }
    let folder = path.parent().filter(|folder| folder != &Path::new(""));
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}

fn written(part: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = File::create_new(part)?;
    file.write_all(content)?;
    file.sync_all()
}
