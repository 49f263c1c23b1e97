//! Records and files compared: what is missing, what is damaged, what has no job.

use futures_util::TryStreamExt;

use super::access::Reach;
use super::blobs::Blobs;
use super::checksum;
use super::job::{Job, JobId};
use super::keys::{input_key, output_key};
use super::listing::Listing;
use super::state::State;
use super::storage::JobStore;
use super::store_error::{StoreError, StoreResult};
use super::timestamp::Timestamp;

/// Jobs of a page.
const PAGE: u32 = 200;
/// Files of younger jobs may belong to a submission under way, in milliseconds.
const SUBMISSION_MS: u64 = 3_600_000;

/// What is wrong with a file that a record lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// It is not there.
    Missing,
    /// It is not what was stored.
    Damaged,
}

/// A file that a record lists and that is not as it was stored.
#[derive(Clone, Debug)]
pub struct LostFile {
    /// Whose file it is.
    pub job: JobId,
    /// Its key.
    pub key: String,
    /// Whether the job made it; otherwise it is a part of its input.
    pub is_output: bool,
    /// What is wrong with it.
    pub loss: Loss,
}

/// What an inspection found.
#[derive(Clone, Debug, Default)]
pub struct Inspection {
    /// Jobs that were looked at.
    pub jobs: usize,
    /// Files that were read.
    pub files: usize,
    /// Files that are not as they were stored.
    pub lost: Vec<LostFile>,
    /// Jobs that have files and no record, with the bytes of these.
    pub unknown: Vec<(JobId, u64)>,
}

/// Reads every file of every job, and looks for files without a job. The service may go on
/// meanwhile.
pub async fn inspect(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<Inspection> {
    let mut inspection = Inspection::default();
    let mut listing = Listing {
        limit: PAGE,
        ..Listing::default()
    };
    loop {
        let page = store.list(&Reach::All, &listing).await?;
        for job in &page {
            inspection.look_at(job, store, blobs).await?;
        }
        match page.last() {
            Some(last) => listing.after = Some(last.id),
            None => break,
        }
    }
    inspection.look_for_unknown(store, blobs).await?;
    Ok(inspection)
}

/// Puts what was found into quarantine: files without a job will be deleted after days, and no job
/// gets a copy of a damaged result.
pub async fn repair(store: &dyn JobStore, found: &Inspection) -> StoreResult<()> {
    store.quarantine(&found.unknown).await?;
    for file in found.lost.iter().filter(|file| file.is_output) {
        store.spoil(file.job).await?;
    }
    Ok(())
}

/// Deletes what is in quarantine and still has no job. Returns how many jobs had these files.
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
    async fn look_at(
        &mut self,
        job: &Job,
        store: &dyn JobStore,
        blobs: &dyn Blobs,
    ) -> StoreResult<()> {
        self.jobs += 1;
        if job.state == State::Cancelled {
            return Ok(());
        }
        let input = job.input.iter().enumerate().map(|(index, file)| {
            let key = input_key(job.id, index);
            (key, file.bytes, file.sha256.as_deref(), false)
        });
        let output = job.output.iter().enumerate().map(|(index, file)| {
            let key = output_key(job.id, job.token, index);
            (key, file.bytes, file.sha256.as_deref(), true)
        });
        for (key, bytes, sha256, is_output) in input.chain(output) {
            self.files += 1;
            let loss = match read(blobs, &key, bytes, sha256).await {
                Ok(()) => continue,
                Err(StoreError::Missing(_)) => Loss::Missing,
                Err(StoreError::Damaged(_)) => Loss::Damaged,
                Err(error) => return Err(error),
            };
            // It may have been deleted or cancelled meanwhile.
            let now = store.get(&Reach::All, job.id).await?;
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

    async fn look_for_unknown(
        &mut self,
        store: &dyn JobStore,
        blobs: &dyn Blobs,
    ) -> StoreResult<()> {
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

/// Reads a whole file and compares its size and its checksum, if that is known.
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
