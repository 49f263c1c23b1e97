//! Comparison of records and files: finds missing, damaged and orphaned files.

use futures_util::TryStreamExt;

use super::access::Visibility;
use super::blobs::Blobs;
use super::checksum;
use super::job::{Job, JobId};
use super::keys::{input_key, output_key};
use super::listing::Listing;
use super::state::State;
use super::storage::JobStore;
use super::store_error::{StoreError, StoreResult};
use super::timestamp::Timestamp;

/// Jobs per page. Larger pages hold more records in memory, smaller ones need more queries.
const PAGE: u32 = 200;
/// Minimum age of files without a job, in milliseconds. Younger ones may belong to a submission under way, which
/// stores its files before its record. A higher age hides orphaned files for longer.
const SUBMISSION_MS: u64 = 3_600_000;

/// Defect of a file that a record lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// It is missing.
    Missing,
    /// Its content is not what was stored.
    Damaged,
}

/// A listed file that is missing or damaged.
#[derive(Clone, Debug)]
pub struct LostFile {
    /// Job that has the file.
    pub job: JobId,
    /// Key of the file.
    pub key: String,
    /// True for an output of the job, false for an input.
    pub is_output: bool,
    /// Defect of the file.
    pub loss: Loss,
}

/// Result of an inspection.
#[derive(Clone, Debug, Default)]
pub struct Inspection {
    /// Number of jobs checked.
    pub jobs: usize,
    /// Number of files read.
    pub files: usize,
    /// Missing and damaged files.
    pub lost: Vec<LostFile>,
    /// Jobs that have files but no record, with the bytes of their files.
    pub unknown: Vec<(JobId, u64)>,
}

/// Reads every file of every job, and looks for files without a job. The service may keep running meanwhile.
pub async fn inspect(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<Inspection> {
    let mut inspection = Inspection::default();
    let mut listing = Listing {
        limit: PAGE,
        ..Listing::default()
    };
    loop {
        let page = store.list(&Visibility::All, &listing).await?;
        for job in &page {
            inspection.check_job(job, store, blobs).await?;
        }
        match page.last() {
            Some(last) => listing.after = Some(last.id),
            None => break,
        }
    }
    inspection.find_unknown(store, blobs).await?;
    Ok(inspection)
}

/// Quarantines what an inspection found: orphaned files will be deleted after some days, and damaged results are no
/// longer copied to other jobs.
pub async fn repair(store: &dyn JobStore, found: &Inspection) -> StoreResult<()> {
    store.quarantine(&found.unknown).await?;
    for file in found.lost.iter().filter(|file| file.is_output) {
        store.spoil(file.job).await?;
    }
    Ok(())
}

/// Deletes quarantined files that still have no job. Returns the number of jobs that had such files.
pub async fn purge(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<usize> {
    let mut purged = 0;
    for files in store.quarantined().await? {
        if store.events(&[files.job]).await?.is_empty() {
            blobs.remove(&files.job.to_string()).await?;
            purged += 1;
        }
        store.release(&[files.job]).await?;
    }
    Ok(purged)
}

impl Inspection {
    async fn check_job(
        &mut self,
        job: &Job,
        store: &dyn JobStore,
        blobs: &dyn Blobs,
    ) -> StoreResult<()> {
        self.jobs += 1;
        if job.state == State::Cancelled {
            return Ok(());
        }
        // List the files that the record promises.
        let input = job.input.iter().enumerate().map(|(index, file)| {
            let key = input_key(job.id, index);
            (key, file.bytes, file.sha256.as_deref(), false)
        });
        let output = job.output.iter().enumerate().map(|(index, file)| {
            let key = output_key(job.id, job.token, index);
            (key, file.bytes, file.sha256.as_deref(), true)
        });
        // Read each of them completely.
        for (key, bytes, sha256, is_output) in input.chain(output) {
            self.files += 1;
            let loss = match read(blobs, &key, bytes, sha256).await {
                Ok(()) => continue,
                Err(StoreError::Missing(_)) => Loss::Missing,
                Err(StoreError::Damaged(_)) => Loss::Damaged,
                Err(error) => return Err(error),
            };
            // Report a loss only if the job still has this file: it may have been deleted or cancelled since.
            let now = store.get(&Visibility::All, job.id).await?;
            if now.is_some_and(|now| now.state == job.state && now.token == job.token) {
                self.lost.push(LostFile {
                    job: job.id,
                    key,
                    is_output,
                    loss,
                });
            }
        }
        Ok(())
    }

    async fn find_unknown(&mut self, store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<()> {
        for id in blobs.owners().await? {
            let is_old = SUBMISSION_MS <= Timestamp::now().since(id.made());
            if is_old && store.events(&[id]).await?.is_empty() {
                let files = blobs.list(&id.to_string()).await?;
                let bytes = files.iter().map(|(_, bytes)| bytes).sum();
                self.unknown.push((id, bytes));
            }
        }
        Ok(())
    }
}

/// Reads a whole file and compares its size, and its checksum if one is known.
async fn read(blobs: &dyn Blobs, key: &str, bytes: u64, sha256: Option<&str>) -> StoreResult<()> {
    let content = blobs.read(key, 0..bytes).await?;
    let content = match sha256 {
        Some(expected) => checksum::checked(content, expected.to_owned()),
        None => content,
    };
    let mut length = 0;
    let count = content.try_for_each(|block| {
        length += block.len() as u64;
        std::future::ready(Ok(()))
    });
    count.await?;
    if length == bytes {
        return Ok(());
    }
    Err(StoreError::Damaged(
        "a stored file is shorter than it was".to_owned(),
    ))
}
