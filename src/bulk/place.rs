//! The output folder, and reading of regular files.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::assets::Asset;

/// Age above which an unfinished file was left by a killed process. Files are written in seconds, but the clocks of
/// machines that share the folder may differ by hours.
const PART_AGE: Duration = Duration::from_hours(24);

/// An output folder, with the state of runs in `.unwrapd`.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    root: PathBuf,
}

impl OutputFolder {
    /// Opens a folder, and creates it if needed. Removes unfinished files that a killed process left a day ago.
    ///
    /// # Errors
    /// Fails if nothing can be written there.
    pub fn open(root: &Path) -> io::Result<Self> {
        let place = Self {
            root: root.to_path_buf(),
        };
        fs::create_dir_all(place.parts())?;
        // Write a probe, so that any other defect of the folder shows now.
        let probe = place.part();
        fs::write(&probe, [])?;
        fs::remove_file(&probe)?;
        for entry in fs::read_dir(place.parts())?.filter_map(Result::ok) {
            let written = entry.metadata().and_then(|of| of.modified());
            let now = SystemTime::now();
            let age = written.ok().and_then(|time| now.duration_since(time).ok());
            if age.is_some_and(|age| PART_AGE <= age) {
                // Another run may have been faster.
                let _ = fs::remove_file(entry.path());
            }
        }
        Ok(place)
    }

    /// Returns the path of a file within the folder.
    pub fn path(&self, within: &Path) -> PathBuf {
        self.root.join(within)
    }

    /// Returns the path of an asset's record within the folder.
    pub(super) fn record(asset: &Asset) -> PathBuf {
        let mut path = Path::new(".unwrapd/records").join(&asset.output);
        path.as_mut_os_string().push(".json");
        path
    }

    /// Writes a file atomically, and creates its folders.
    ///
    /// # Errors
    /// Fails if it cannot be written; an existing file is then unchanged.
    pub fn write(&self, within: &Path, content: &[u8]) -> io::Result<()> {
        let path = self.path(within);
        fs::create_dir_all(path.parent().unwrap_or(&self.root))?;
        write_whole(&path, &self.part(), content)
    }

    /// Removes a file if it exists.
    pub(super) fn remove(&self, within: &Path) -> io::Result<()> {
        match fs::remove_file(self.path(within)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            removed => removed,
        }
    }

    fn parts(&self) -> PathBuf {
        self.root.join(".unwrapd/parts")
    }

    /// Returns a path for an unfinished file that no other process uses, on any machine.
    fn part(&self) -> PathBuf {
        self.parts().join(uuid::Uuid::now_v7().to_string())
    }
}

// Files that are complete or absent, even after a system crash.

/// Writes a file as `part` and moves it to `path`. Syncs the content before the name, and the name before returning.
///
/// # Errors
/// Fails if it cannot be written; the file at `path` is then unchanged.
fn write_whole(path: &Path, part: &Path, content: &[u8]) -> io::Result<()> {
    let written = written(part, content).and_then(|()| fs::rename(part, path));
    if let Err(error) = written {
        // Only the first error is reported.
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

// Reading of regular files of bounded size.

/// Maximum size of a file in bytes: 4 GiB, since a GLB stores its length as a 32-bit number.
pub const MOST_BYTES: u64 = 1 << 32;

/// Reads a regular file, or the target of a link to one.
///
/// A pipe may never have a writer, and a device may never end, so neither is opened.
///
/// # Errors
/// Fails if it cannot be read, is not a regular file, or has more than [`MOST_BYTES`].
pub fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    check(&fs::metadata(path)?)?;
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

fn check(file: &fs::Metadata) -> io::Result<()> {
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
