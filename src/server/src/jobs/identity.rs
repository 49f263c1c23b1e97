//! The identity that a database and its files share.
//!
//! If a database is missing, empty or belongs to another service, every file looks like one without a job. So both
//! carry the same random id, and a process starts only if they match. A store of version 0.1.0 has no id; it gets one
//! when a job of the database has files.

use super::blobs::Blobs;
use super::job::JobId;
use super::storage::JobStore;
use super::store_error::{StoreError, StoreResult};
use super::store_id::StoreId;

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
