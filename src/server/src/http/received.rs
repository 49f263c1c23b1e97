//! The result of receiving an upload.

use std::path::PathBuf;

use serde_json::Value;

use super::submission_headers::SubmissionHeaders;
use crate::jobs::access::Owner;
use crate::jobs::{Digest, Handling, Scratch, Submission};
use unwrapd_api::{InputFile, Kind};

/// A received upload. Its folder is removed on drop.
pub(super) struct Received {
    pub folder: Scratch,
    pub kind: Kind,
    /// Options, complete with defaults.
    pub options: Value,
    pub files: Vec<(InputFile, PathBuf)>,
    pub handling: Handling,
}

impl Received {
    /// Returns the submission for an owner, and the folder, which must be kept until the submission is done.
    pub fn into_submission(
        self,
        owner: &Owner,
        submission_headers: SubmissionHeaders,
        ephemeral: bool,
    ) -> (Submission, Scratch) {
        let submission = Submission {
            owner: owner.clone(),
            digest: Digest::of_job(self.kind, &self.options, self.files.iter().map(|(f, _)| f)),
            kind: self.kind,
            options: self.options,
            files: self.files,
            handling: self.handling,
            trace: submission_headers.trace,
            reuse: submission_headers.reuse,
            key: submission_headers.key,
            ephemeral,
        };
        (submission, self.folder)
    }
}
