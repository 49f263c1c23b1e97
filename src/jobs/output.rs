//! What jobs made, and what they made it of, as it is read.

use std::ops::Range;

use super::blobs::Content;
use super::checksum;
use super::input_output::{InputFile, OutputFile};
use super::job::Job;
use super::keys::{input_key, output_key};
use super::queue::Jobs;
use super::store_error::StoreResult;

impl Jobs {
    /// Reads these bytes of a file that a job made. The whole of it is checked as it passes, and
    /// ends with an error if it is damaged.
    pub async fn read(
        &self,
        job: &Job,
        file: &OutputFile,
        range: Range<u64>,
    ) -> StoreResult<Content> {
        let index = job.output.iter().position(|other| other == file);
        let key = output_key(job.id, job.token, index.unwrap_or_default());
        let whole = (0..file.bytes, file.sha256.as_deref());
        self.read_checked(&key, whole, range).await
    }

    /// Reads these bytes of a file of a job's input, checked in the same way.
    pub async fn read_input(
        &self,
        job: &Job,
        file: &InputFile,
        range: Range<u64>,
    ) -> StoreResult<Content> {
        let index = job.input.iter().position(|other| other == file);
        let key = input_key(job.id, index.unwrap_or_default());
        let whole = (0..file.bytes, file.sha256.as_deref());
        self.read_checked(&key, whole, range).await
    }

    async fn read_checked(
        &self,
        key: &str,
        (whole, sha256): (Range<u64>, Option<&str>),
        range: Range<u64>,
    ) -> StoreResult<Content> {
        let expected = sha256.filter(|_| range == whole);
        let content = self.blobs.read(key, range).await?;
        Ok(match expected {
            Some(expected) => checksum::checked(content, expected.to_owned()),
            None => content,
        })
    }
}
