//! Failed jobs tried again, many at once.

use super::access::Reach;
use super::job::{Job, JobId};
use super::listing::{Listing, Order};
use super::queue::Jobs;
use super::state::State;
use super::storage::{Changed, JobStore};
use super::store_error::StoreResult;
use super::transition::{Happening, Wish};

/// Jobs that are looked at together.
const PAGE: u32 = 200;
/// Jobs that one call tries again.
const MOST: usize = 1000;

/// Failed jobs that were queued again.
#[derive(Debug, Default)]
pub struct Retried {
    /// These, the oldest first.
    pub jobs: Vec<Job>,
    /// There may be more after this one.
    pub next: Option<JobId>,
}

/// Tries up to 1000 failed jobs again: those that a listing asks for, the oldest first, that failed
/// with this code if there is one.
pub async fn retry_failed(
    store: &dyn JobStore,
    reach: &Reach,
    listing: Listing,
    code: Option<&str>,
) -> StoreResult<Retried> {
    let mut listing = Listing {
        state: Some(State::Failed),
        order: Order::OldestFirst,
        limit: PAGE,
        ..listing
    };
    let mut retried = Retried::default();
    loop {
        let page = store.list(reach, &listing).await?;
        for job in &page {
            let failure = job.failure.as_ref().map(|failure| failure.code.as_str());
            if code.is_some() && failure != code {
                continue;
            }
            let again = Happening::Wished(Wish::Retry);
            if let Changed::Yes(job) = store.change(reach, job.id, &again).await? {
                retried.jobs.push(*job);
            }
            if MOST <= retried.jobs.len() {
                retried.next = Some(job.id);
                return Ok(retried);
            }
        }
        match page.last() {
            Some(last) => listing.after = Some(last.id),
            None => return Ok(retried),
        }
    }
}

impl Jobs {
    /// Tries failed jobs again; see [`retry_failed`].
    pub async fn retry_failed(
        &self,
        reach: &Reach,
        listing: Listing,
        code: Option<&str>,
    ) -> StoreResult<Retried> {
        let retried = retry_failed(self.store.as_ref(), reach, listing, code).await?;
        for job in &retried.jobs {
            self.tell(job).await;
        }
        Ok(retried)
    }
}
