//! Temporary folder on a local disk.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

const PREFIX: &str = "unwrapd-bulk-";
const LOCK: &str = "lock";

/// A folder of this process in the temporary folder (`TMPDIR`). It is removed on drop.
#[derive(Debug)]
pub struct Scratch {
    path: PathBuf,
    /// Lock that the system releases when the process ends.
    _lock: File,
}

impl Scratch {
    /// Creates a folder, and removes those of killed processes.
    ///
    /// # Errors
    /// Fails if it cannot be created.
    pub fn new() -> io::Result<Self> {
        let all = std::env::temp_dir();
        for entry in fs::read_dir(&all)?.filter_map(Result::ok) {
            let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX);
            if is_ours && is_abandoned(&entry.path()) {
                // Another process may be removing it too.
                let _ = fs::remove_dir_all(entry.path());
            }
        }
        let path = all.join(format!("{PREFIX}{}", uuid::Uuid::now_v7()));
        fs::create_dir(&path)?;
        let lock = File::create(path.join(LOCK))?;
        lock.lock()?;
        Ok(Self { path, _lock: lock })
    }

    /// Creates an empty subfolder.
    pub(super) fn folder(&self, name: usize) -> io::Result<PathBuf> {
        let path = self.path.join(name.to_string());
        fs::create_dir(&path)?;
        Ok(path)
    }
}

/// Returns whether the process that made a folder has ended. A folder without a lock file is just being made.
fn is_abandoned(folder: &Path) -> bool {
    File::open(folder.join(LOCK)).is_ok_and(|lock| lock.try_lock().is_ok())
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What is left is removed by a later process.
        let _ = fs::remove_dir_all(&self.path);
    }
}
