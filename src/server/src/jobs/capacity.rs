//! Storage use, and admission of new jobs.

use std::time::Duration;

use super::queue::Jobs;
use super::quotas::Capacity;
use super::space::free_bytes;
use super::store_error::{StoreError, StoreResult};

/// Period over which the throughput of the queue is measured. Over longer periods the estimate lags behind changes;
/// in shorter ones too few long jobs end.
const THROUGHPUT_PERIOD: Duration = Duration::from_mins(5);
/// Estimated wait for a place in the queue when no job has ended lately. Without a throughput there is nothing to
/// derive it from.
const UNKNOWN_WAIT: Duration = Duration::from_mins(1);

/// Timeout for file storage to respond. `/readyz` and `/metrics` take this long at most if it hangs.
const BLOBS_PATIENCE: Duration = Duration::from_secs(5);

/// Storage in use and available.
#[derive(Clone, Copy, Debug)]
pub struct Usage {
    /// Bytes of the files of all jobs, including quarantined files.
    pub stored: u64,
    /// Number of jobs without a record whose files are quarantined.
    pub quarantined: usize,
    /// Bytes of quarantined files.
    pub quarantined_bytes: u64,
    /// Maximum for `stored`; `None` if there is no quota.
    pub quota: Option<u64>,
    /// Free bytes in file storage; `None` if it does not count them.
    pub free: Option<u64>,
    /// Free bytes on the disk of uploads and attempts.
    pub scratch_free: u64,
}

impl Jobs {
    /// Returns the limits on what may be stored.
    pub(super) fn capacity(&self) -> Capacity {
        Capacity {
            depth: self.settings.queue_depth,
            bytes: self.settings.quota,
            of_owner: self.settings.of_owner,
        }
    }

    /// Estimates when a place in the queue will be free, from the throughput of the last minutes.
    pub(super) async fn next_place(&self) -> Duration {
        match self.store.ended_within(THROUGHPUT_PERIOD).await {
            Ok(ended @ 1..) => {
                (THROUGHPUT_PERIOD / ended.min(1000) as u32).max(Duration::from_secs(1))
            }
            _ => UNKNOWN_WAIT,
        }
    }

    /// Returns what is stored and what is free.
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

    /// Checks that the disks have room for what a job needs. Refusing early leaves room for running jobs to end.
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

    /// Checks that the files belong to this store and that more can be stored.
    pub async fn check_blobs(&self) -> StoreResult<()> {
        // Compare the identity first: a probe would also succeed on an empty mount point.
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

    /// Checks that a job would be accepted now: records and files can be written, disks have room, and the quota is
    /// not used up.
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
