//! Comparison of records and files: whether they belong together, and which files are missing, damaged or orphaned.

use futures_util::TryStreamExt;

use super::access::Visibility;
use super::files::{self, input_key, output_key};
use super::job::{Job, JobId, State};
use super::storage::{Blobs, JobStore, Listing, StoreId};
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
        Some(expected) => files::checked(content, expected.to_owned()),
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

// The identity that a database and its files share.
//
// If a database is missing, empty or belongs to another service, every file looks like one without a job. So both
// carry the same random id, and a process starts only if they match. A store of version 0.1.0 has no id; it gets one
// when a job of the database has files.

/// Number of jobs looked up at once. The search stops after the first batch with a known job.
const TOGETHER: usize = 1000;

/// Returns the identity that records and files share. New stores, and those of version 0.1.0, get one.
///
/// # Errors
/// Returns why the two do not belong together, and what to do about it.
pub async fn shared_identity(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<StoreId> {
    match (store.identity().await?, blobs.identity().await?) {
        (Some(records), Some(files)) if records == files => Ok(records),
        (Some(records), Some(files)) => Err(StoreError::Other(format!(
            "the database is of store {records}, but the files are of store {files}: name the \
             database and the place for files that belong together (see `unwrapd check --help`)"
        ))),
        (records, files) => {
            check_match(store, blobs).await?;
            let known = files.or(records).unwrap_or_else(StoreId::fresh);
            // If several processes start together, the first one chooses.
            let chosen = store.identify(known).await?;
            if files.is_none() {
                blobs.identify(chosen).await?;
            }
            Ok(chosen)
        }
    }
}

/// Gives records and files a common identity, whatever they had before.
pub async fn adopt(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<StoreId> {
    let chosen = store.identify(StoreId::fresh()).await?;
    blobs.identify(chosen).await?;
    Ok(chosen)
}

/// Checks from the contents that records and files belong together: neither has any, or some job has both.
async fn check_match(store: &dyn JobStore, blobs: &dyn Blobs) -> StoreResult<()> {
    let census = store.census().await?;
    let owners = blobs.owners().await?;
    let why = match (census.jobs, owners.len()) {
        (0, 0) => return Ok(()),
        (_, 0) if census.with_files == 0 => return Ok(()),
        (_, 0) => format!(
            "the database has {} jobs with files, but the place for files is empty: mount it, \
             restore it, or name the right one",
            census.with_files
        ),
        (0, files) => format!(
            "the database is empty, but there are files of {files} jobs: restore its backup, or \
             name the right database"
        ),
        _ if is_any_known(store, &owners).await? => return Ok(()),
        (_, files) => format!(
            "the database knows none of the {files} jobs that have files: name the database and \
             the place for files that belong together"
        ),
    };
    Err(StoreError::Other(format!(
        "{why}. If they do belong together, as after a restore, or where only files are left, run \
         `unwrapd check --adopt` (see `unwrapd check --help`)"
    )))
}

async fn is_any_known(store: &dyn JobStore, owners: &[JobId]) -> StoreResult<bool> {
    for owners in owners.chunks(TOGETHER) {
        if !store.events(owners).await?.is_empty() {
            return Ok(true);
        }
    }
    Ok(false)
}
