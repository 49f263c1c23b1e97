//! Reading of regular files of bounded size.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Maximum size of a file in bytes: 4 GiB, since a GLB stores its length as a 32-bit number.
pub const MOST_BYTES: u64 = 1 << 32;

/// Reads a regular file, or the target of a link to one.
///
/// A pipe may never have a writer, and a device may never end, so neither is opened.
///
/// # Errors
/// Fails if it cannot be read, is not a regular file, or has more than [`MOST_BYTES`].
pub fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    check(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    // Another file may have taken the name since.
    check(&file.metadata()?)?;
    read_bounded(file, MOST_BYTES)
}

/// Reads a stream to its end.
///
/// # Errors
/// Fails if it cannot be read, or has more bytes than `most`.
pub fn read_bounded(stream: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream
        .take(most.saturating_add(1))
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large(most));
    }
    Ok(bytes)
}

fn check(file: &std::fs::Metadata) -> io::Result<()> {
    if file.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !file.is_file() {
        let text = "not a regular file but a pipe, socket or device";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
    }
    if file.len() > MOST_BYTES {
        return Err(too_large(MOST_BYTES));
    }
    Ok(())
}

fn too_large(most: u64) -> io::Error {
    let text = format!("larger than {} MiB", most >> 20);
    io::Error::new(io::ErrorKind::FileTooLarge, text)
}
