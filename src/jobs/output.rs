//! What jobs made, as it is read.

use std::ops::Range;

use super::checksum;
use super::input_output::OutputFile;
use super::job::Job;
use super::keys::output_key;
use super::queue::Jobs;
use super::storage::Content;
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
        let is_whole = range == (0..file.bytes);
        let content = self.blobs.read(&key, range).await?;
        Ok(match &file.sha256 {
            Some(expected) if is_whole => checksum::checked(content, expected.clone()),
            _ => content,
        })
    }
}
