//! What jobs made, and what they made it of, as it is read.

use std::ops::Range;
use std::path::Path;

use futures_util::TryStreamExt;

use super::blobs::Content;
use super::checksum;
use super::job::Job;
use super::keys::{input_key, output_key};
use super::meters;
use super::queue::Jobs;
use super::store_error::{StoreError, StoreResult};
use unwrapd_api::{InputFile, OutputFile};

/// Files of at most so many bytes are verified before their first byte is passed on, also where only
/// a range of them is read. They are read twice then, which takes a tenth of a second at most. Larger
/// ones are verified as they pass, if they are read as a whole.
const VERIFIED_FIRST: u64 = 16 << 20;

/// A stored file of a job: its key, its size and its checksum, if that is known.
struct Stored<'a> {
    key: String,
    bytes: u64,
    sha256: Option<&'a str>,
}

impl Jobs {
    /// Reads these bytes of a file that a job made. A damaged file is an error before the first byte
    /// if it is small, else instead of the last block. The job no longer serves as a copy for equal
    /// ones then.
    pub async fn read(
        &self,
        job: &Job,
        file: &OutputFile,
        range: Range<u64>,
    ) -> StoreResult<Content> {
        let index = job.output.iter().position(|other| other == file);
        let stored = Stored::output(job, index.unwrap_or_default(), file);
        let content = self.read_verified(&stored, range).await;
        if content.as_ref().is_err_and(StoreError::is_loss) {
            self.spoil(job).await;
        }
        content
    }

    /// Reads these bytes of a file of a job's input, verified in the same way.
    pub async fn read_input(
        &self,
        job: &Job,
        file: &InputFile,
        range: Range<u64>,
    ) -> StoreResult<Content> {
        let index = job.input.iter().position(|other| other == file);
        let stored = Stored {
            key: input_key(job.id, index.unwrap_or_default()),
            bytes: file.bytes,
            sha256: file.sha256.as_deref(),
        };
        self.read_verified(&stored, range).await
    }

    /// Reads a file that a job made, to see whether it is whole.
    pub(super) async fn verify(
        &self,
        job: &Job,
        index: usize,
        file: &OutputFile,
    ) -> StoreResult<()> {
        let verified = self.verify_stored(&Stored::output(job, index, file)).await;
        match verified {
            Err(error) => Err(self.lost_file(error).await),
            Ok(()) => Ok(()),
        }
    }

    /// Brings a stored file to a local path and compares its checksum, if that is known.
    pub(super) async fn fetch_verified(
        &self,
        key: &str,
        sha256: Option<&str>,
        to: &Path,
    ) -> StoreResult<()> {
        let fetched = async {
            self.blobs.fetch(key, to).await?;
            checksum::check(to, sha256).await
        };
        match fetched.await {
            Err(error) => Err(self.lost_file(error).await),
            Ok(()) => Ok(()),
        }
    }

    /// Has no equal job get a copy of the result of this one.
    pub(super) async fn spoil(&self, job: &Job) {
        tracing::error!(job = %job.id, "a stored result is missing or damaged");
        if let Err(error) = self.store.spoil(job.id).await {
            tracing::warn!(job = %job.id, %error, "a damaged result may still be copied");
        }
    }

    /// Why a file could not be read: if it is missing, the whole place for files may be.
    pub(super) async fn lost_file(&self, error: StoreError) -> StoreError {
        if !error.is_loss() {
            return error;
        }
        if let Err(away) = self.check_blobs().await {
            return away;
        }
        meters::file_lost();
        error
    }

    async fn read_verified(&self, stored: &Stored<'_>, range: Range<u64>) -> StoreResult<Content> {
        let content = async {
            if stored.bytes <= VERIFIED_FIRST {
                self.verify_stored(stored).await?;
            }
            let is_whole = range == (0..stored.bytes);
            let content = self.blobs.read(&stored.key, range).await?;
            Ok(match stored.sha256.filter(|_| is_whole) {
                Some(expected) => checksum::checked(content, expected.to_owned()),
                None => content,
            })
        };
        match content.await {
            Err(error) => {
                let error = self.lost_file(error).await;
                tracing::warn!(key = stored.key, %error, "file not read");
                Err(error)
            }
            content => content,
        }
    }

    async fn verify_stored(&self, stored: &Stored<'_>) -> StoreResult<()> {
        let content = self.blobs.read(&stored.key, 0..stored.bytes).await?;
        let Some(expected) = stored.sha256 else {
            return Ok(());
        };
        let checked = checksum::checked(content, expected.to_owned());
        checked.try_for_each(async |_| Ok(())).await
    }
}

impl<'a> Stored<'a> {
    fn output(job: &Job, index: usize, file: &'a OutputFile) -> Self {
        Self {
            key: output_key(job.id, job.token, index),
            bytes: file.bytes,
            sha256: file.sha256.as_deref(),
        }
    }
}
