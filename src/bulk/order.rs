//! Settings of a run.

use super::asset::Asset;
use super::place::Place;
use super::worker::Extra;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use unwrapd_files::document::Upload;
use unwrapd_pipeline::{Options, Workers};
use unwrapd_server::jobs::Digest;

/// Settings of a run.
pub struct Order {
    /// Assets of this shard.
    pub assets: Vec<Asset>,
    /// Output folder.
    pub place: Place,
    /// Folder for temporary files.
    pub scratch: Scratch,
    /// Files to write beside outputs.
    pub extras: Vec<Extra>,
    /// Set to retry assets that failed permanently.
    pub retries: bool,
    /// Maximum number of assets in progress.
    pub concurrency: usize,
    pub(super) recipe: Recipe,
}

/// Origin of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// An earlier run did the work.
    Kept,
    /// This run did the work.
    Done,
}

impl Order {
    /// Creates a run of one asset at a time, by a worker of this version.
    ///
    /// # Errors
    /// Fails if the scratch folder cannot be created, or the options cannot be written as JSON.
    pub fn new(
        assets: Vec<Asset>,
        place: Place,
        version: &str,
        options: &Options,
        extras: Vec<Extra>,
    ) -> io::Result<Self> {
        Ok(Self {
            assets,
            place,
            scratch: Scratch::new()?,
            recipe: Recipe::new(version, options, &extras)?,
            extras,
            retries: false,
            concurrency: 1,
        })
    }
}

// Digests of everything that determines an output.

/// Digest of the settings shared by all assets of a run.
#[derive(Clone, Debug)]
pub(super) struct Recipe(Digest);

impl Recipe {
    /// Creates the digest of a worker's version, the options, and the extra files. The number of threads does not
    /// count, because outputs do not depend on it.
    pub fn new(version: &str, options: &Options, extras: &[Extra]) -> serde_json::Result<Self> {
        let options = Options {
            workers: Workers::default(),
            ..options.clone()
        };
        let mut digest = Digest::default();
        digest.add(version.as_bytes());
        digest.add(&serde_json::to_vec(&options)?);
        for extra in extras {
            digest.add(extra.suffix().as_bytes());
        }
        Ok(Self(digest))
    }

    /// Returns the digest of an asset.
    pub fn with(&self, upload: &Upload) -> String {
        let mut digest = self.0.clone();
        digest.add(upload.name.as_bytes());
        digest.add(&upload.bytes);
        for (name, bytes) in &upload.resources {
            digest.add(name.as_bytes());
            digest.add(bytes);
        }
        digest.finish()
    }
}

// Temporary folder on a local disk.

/// Prefix of the folders of all processes, and the name of the lock file in each.
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
        // A later process removes what is left.
        let _ = fs::remove_dir_all(&self.path);
    }
}
