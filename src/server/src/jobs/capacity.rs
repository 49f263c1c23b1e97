//! Whether there is room for more jobs.

use std::time::Duration;

use super::queue::Jobs;
use super::quotas::Capacity;
use super::space::free_bytes;
use super::store_error::{StoreError, StoreResult};

/// Over which the pace of the queue is taken.
const PACE_TIME: Duration = Duration::from_mins(5);
/// For a place in a queue that has no pace.
const WITHOUT_PACE: Duration = Duration::from_mins(1);

/// For the place for files to answer.
const BLOBS_PATIENCE: Duration = Duration::from_secs(5);

/// How much is stored, and how much more may be.
#[derive(Clone, Copy, Debug)]
pub struct Usage {
    /// Bytes of the files of all jobs, and of those in quarantine.
    pub stored: u64,
    /// Jobs without a record whose files are in quarantine.
    pub quarantined: usize,
    /// Bytes of these files.
    pub quarantined_bytes: u64,
    /// Bytes that they may take together; `None` for as much as there is.
    pub quota: Option<u64>,
    /// Free bytes where they lie; `None` where nobody counts.
    pub free: Option<u64>,
    /// Free bytes where uploads and attempts lie.
    pub scratch_free: u64,
}

impl Jobs {
    /// How much may be stored.
    pub(super) fn capacity(&self) -> Capacity {
        Capacity {
            depth: self.settings.queue_depth,
            bytes: self.settings.quota,
            of_owner: self.settings.of_owner,
        }
    }

    /// After which time a place in the queue will be free, at its pace of the last minutes.
    pub(super) async fn next_place(&self) -> Duration {
        match self.store.ended_within(PACE_TIME).await {
            Ok(ended @ 1..) => (PACE_TIME / ended.min(1000) as u32).max(Duration::from_secs(1)),
            _ => WITHOUT_PACE,
        }
    }

    /// What is stored, and what is free.
    pub async fn usage(&self) -> StoreResult<Usage> {
        let quarantined = self.store.quarantined().await?;
        Ok(Usage {
            stored: self.store.stored_bytes().await?,
            quarantined: quarantined.len(),
            quarantined_bytes: quarantined.iter().map(|files| files.bytes).sum(),
            quota: self.settings.quota,
            free: self.blobs.free_bytes()?,
            scratch_free: free_bytes(&self.settings.scratch)?,
        })
    }

    /// Whether the disks have room for what a job needs. Refusing early leaves room for the ends of those that run.
    pub fn has_room(&self) -> StoreResult<()> {
        let scratch = free_bytes(&self.settings.scratch)?;
        let free = self.blobs.free_bytes()?.unwrap_or(scratch).min(scratch);
        if free < self.settings.min_free {
            let (free, least) = (free >> 20, self.settings.min_free >> 20);
            let detail = format!("{free} MiB are free, and {least} MiB must be");
            return Err(StoreError::Full(detail));
        }
        Ok(())
    }

    /// Whether the files are those of this store, and more can be stored.
    pub async fn check_blobs(&self) -> StoreResult<()> {
        let check = async {
            if let Some(own) = self.identity.get() {
                match self.blobs.identity().await? {
                    Some(found) if found == *own => {}
                    Some(found) => {
                        let detail = format!("the files are of store {found}, not of {own}");
                        return Err(StoreError::Unavailable(detail));
                    }
                    None => {
                        let detail = "the place for files is empty: is it mounted?".to_owned();
                        return Err(StoreError::Unavailable(detail));
                    }
                }
            }
            self.blobs.check().await
        };
        let late = || StoreError::Unavailable("the place for files does not answer".to_owned());
        let answer = tokio::time::timeout(BLOBS_PATIENCE, check).await;
        answer.unwrap_or_else(|_| Err(late()))
    }

    /// Whether a job would be accepted now: records and files can be written,
    /// disks have room, and the quota is not used up.
    pub async fn check(&self) -> StoreResult<()> {
        self.store.check().await?;
        self.has_room()?;
        self.check_blobs().await?;
        match self.settings.quota {
            Some(quota) if quota <= self.store.stored_bytes().await? => {
                let detail = format!("the jobs use all of their {} MiB", quota >> 20);
                Err(StoreError::Full(detail))
            }
            _ => Ok(()),
        }
    }
}
