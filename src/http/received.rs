//! A received upload.

use std::path::PathBuf;

use serde_json::Value;

use super::wishes::Wishes;
use crate::jobs::{InputFile, Kind, Submission};

/// A received upload. Its folder goes when it is dropped.
pub(super) struct Received {
    pub folder: Folder,
    pub kind: Kind,
    /// The options, complete.
    pub options: Value,
    pub files: Vec<(InputFile, PathBuf)>,
    pub priority: i32,
    /// Of kind, options and files.
    pub digest: String,
}

impl Received {
    /// What is to be submitted; the folder has to be kept until that is done.
    pub fn into_submission(self, wishes: Wishes, ephemeral: bool) -> (Submission, Folder) {
        let submission = Submission {
            kind: self.kind,
            options: self.options,
            files: self.files,
            digest: self.digest,
            priority: self.priority,
            reuse: wishes.reuse,
            key: wishes.key,
            ephemeral,
        };
        (submission, self.folder)
    }
}

/// A folder for one upload, removed when dropped.
pub(super) struct Folder(pub PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        if let Err(error) = std::fs::remove_dir_all(&self.0) {
            tracing::warn!(%error, "folder of an upload not removed");
        }
    }
}
