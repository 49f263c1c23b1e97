//! A folder for what is in the making, on a local disk.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

const PREFIX: &str = "unwrapd-bulk-";
const LOCK: &str = "lock";

/// A folder of this process among the temporary files (`TMPDIR`). Dropping it removes it.
#[derive(Debug)]
pub struct Scratch {
    path: PathBuf,
    /// Goes with the process.
    _lock: File,
}

impl Scratch {
    /// Makes a folder, and removes those of processes that were killed.
    ///
    /// # Errors
    /// If it cannot be made.
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

    /// Makes an empty folder within.
    pub(super) fn folder(&self, name: usize) -> io::Result<PathBuf> {
        let path = self.path.join(name.to_string());
        fs::create_dir(&path)?;
        Ok(path)
    }
}

/// Whether the process that made a folder has ended. One without a lock is just being made.
fn is_abandoned(folder: &Path) -> bool {
    File::open(folder.join(LOCK)).is_ok_and(|lock| lock.try_lock().is_ok())
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What is left is removed by a later process.
        let _ = fs::remove_dir_all(&self.path);
    }
}
