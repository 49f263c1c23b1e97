//! Verified reading of the files of jobs, and reuse of results.

use std::ops::Range;
use std::path::Path;

use futures_util::TryStreamExt;

use super::files::{self, input_key, output_key};
use super::job::{Job, State};
use super::meters;
use super::queue::Jobs;
use super::storage::Content;
use super::store_error::{StoreError, StoreResult};
use unwrapd_api::{InputFile, OutputFile};

/// Maximum size in bytes of files that are verified before their first byte is passed on, even if only a range of
/// them is read. They are read twice, which takes a tenth of a second at most; a higher limit delays the first byte
/// further. Larger files are verified in passing, if they are read as a whole.
const VERIFIED_FIRST: u64 = 16 << 20;

/// A stored file of a job: key, size and checksum, if known.
struct Stored<'a> {
    key: String,
    bytes: u64,
    sha256: Option<&'a str>,
}

impl Jobs {
    /// Reads a byte range of an output file. If the file is damaged, a small one fails before the first byte and a
    /// large one in place of its last block. If the failure comes first, the job is no longer copied for equal jobs.
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

    /// Reads a byte range of an input file, verified in the same way.
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

    /// Reads a whole output file to verify it.
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

    /// Copies a stored file to a local path and compares its checksum, if known.
    pub(super) async fn fetch_verified(
        &self,
        key: &str,
        sha256: Option<&str>,
        to: &Path,
    ) -> StoreResult<()> {
        let fetched = async {
            self.blobs.fetch(key, to).await?;
            files::check_sha256(to, sha256).await
        };
        match fetched.await {
            Err(error) => Err(self.lost_file(error).await),
            Ok(()) => Ok(()),
        }
    }

    /// Excludes the result of this job from being copied for equal jobs.
    pub(super) async fn spoil(&self, job: &Job) {
        tracing::error!(job = %job.id, "a stored result is missing or damaged");
        if let Err(error) = self.store.spoil(job.id).await {
            tracing::warn!(job = %job.id, %error, "a damaged result may still be copied");
        }
    }

    /// Returns the cause of a failed read: if a file is missing, all of file storage may be.
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
                Some(expected) => files::checked(content, expected.to_owned()),
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
        let checked = files::checked(content, expected.to_owned());
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

// Reuse of results among equal jobs.

impl Jobs {
    /// Returns the checksum of the program, since another build may compute different results.
    pub(super) async fn engine(&self) -> StoreResult<&str> {
        let file = &self.settings.program.engine;
        let engine = self.engine.get_or_try_init(|| files::sha256_of(file));
        engine.await.map(String::as_str)
    }

    /// Completes a new job with copies of the results of an equal, undamaged job of its owner, if there is one. If
    /// copying fails, the job stays queued and is computed; partial copies are removed with the job.
    pub(super) async fn reuse(&self, job: &mut Job) {
        match self.copy_equal(job).await {
            Ok(Some(earlier)) => {
                tracing::info!(job = %job.id, %earlier.id, "equal to an earlier job");
                job.state = State::Succeeded;
                job.progress.fraction = 1.0;
                job.finished = Some(job.created);
                job.output = earlier.output;
                job.verdict = earlier.verdict;
            }
            Ok(None) => {}
            Err(error) => tracing::warn!(job = %job.id, %error, "no earlier result reused"),
        }
    }

    /// Copies the files of an equal job and returns that job.
    async fn copy_equal(&self, job: &Job) -> StoreResult<Option<Job>> {
        let engine = self.engine().await?;
        let equal = self.store.equal(job).await?;
        for earlier in equal {
            if !earlier.is_repeatable(engine) {
                continue;
            }
            match self.copy_verified(&earlier, job).await {
                Ok(()) => return Ok(Some(earlier)),
                Err(error) if error.is_loss() => self.spoil(&earlier).await,
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Copies the output of an earlier job if all of it is intact.
    async fn copy_verified(&self, earlier: &Job, job: &Job) -> StoreResult<()> {
        for (index, file) in earlier.output.iter().enumerate() {
            self.verify(earlier, index, file).await?;
        }
        for index in 0..earlier.output.len() {
            let from = output_key(earlier.id, earlier.token, index);
            let to = output_key(job.id, job.token, index);
            self.blobs.copy(&from, &to).await?;
        }
        Ok(())
    }
}

impl Job {
    /// Returns whether the result is a copy of an earlier job's.
    pub fn is_copy(&self) -> bool {
        self.state == State::Succeeded && self.attempt == 0
    }

    /// Returns whether this engine would compute the same result: the job was not ended early.
    fn is_repeatable(&self, engine: &str) -> bool {
        let mut warnings = self.verdict.warnings.iter();
        self.state == State::Succeeded
            && self.verdict.engine == engine
            && !warnings.any(|warning| warning.code == "ended_early")
    }
}
