//! The output folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::asset::Asset;
use super::whole::write_whole;

/// What is older was left by a process that was killed.
const PART_AGE: Duration = Duration::from_hours(24);

/// An output folder, with what runs know of it in `.unwrapd`.
#[derive(Clone, Debug)]
pub struct Place {
    root: PathBuf,
}

impl Place {
    /// Uses a folder, and makes it if need be. Unfinished files that a killed process left a day ago
    /// are removed.
    ///
    /// # Errors
    /// If nothing can be written there.
    pub fn open(root: &Path) -> io::Result<Self> {
        let place = Self {
            root: root.to_path_buf(),
        };
        fs::create_dir_all(place.parts())?;
        // Whatever else is wrong with the folder shows now.
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

    /// A path within the folder.
    pub fn path(&self, within: &Path) -> PathBuf {
        self.root.join(within)
    }

    /// Where the record of an asset lies within the folder.
    pub(super) fn record(asset: &Asset) -> PathBuf {
        let mut path = Path::new(".unwrapd/records").join(&asset.output);
        path.as_mut_os_string().push(".json");
        path
    }

    /// Writes a file whole, with the folders that it needs.
    ///
    /// # Errors
    /// If it cannot be written; then an old one is as it was.
    pub fn write(&self, within: &Path, content: &[u8]) -> io::Result<()> {
        let path = self.path(within);
        fs::create_dir_all(path.parent().unwrap_or(&self.root))?;
        write_whole(&path, &self.part(), content)
    }

    /// Removes a file if it is there.
    pub(super) fn remove(&self, within: &Path) -> io::Result<()> {
        match fs::remove_file(self.path(within)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            removed => removed,
        }
    }

    fn parts(&self) -> PathBuf {
        self.root.join(".unwrapd/parts")
    }

    /// A name that no other process uses, on any machine.
    fn part(&self) -> PathBuf {
        self.parts().join(uuid::Uuid::now_v7().to_string())
    }
}
