//! Retrying many failed jobs at once.

use super::access::Visibility;
use super::job::{Job, JobId};
use super::listing::{Listing, Order};
use super::queue::Jobs;
use super::state::State;
use super::storage::{Changed, JobStore};
use super::store_error::StoreResult;
use super::transition::{Command, Transition};

/// Jobs per page. Larger pages hold more records in memory, smaller ones need more queries.
const PAGE: u32 = 200;
/// Maximum number of jobs retried by one request, which bounds its duration; clients continue with `next`.
const MOST: usize = 1000;

/// Failed jobs that were requeued.
#[derive(Debug, Default)]
pub struct Retried {
    /// The jobs, oldest first.
    pub jobs: Vec<Job>,
    /// Job after which there may be more; `None` if all were retried.
    pub next: Option<JobId>,
}

/// Retries up to 1000 failed jobs that match a listing, oldest first. If a code is given, retries only jobs that
/// failed with it.
pub async fn retry_failed(
    store: &dyn JobStore,
    visibility: &Visibility,
    listing: Listing,
    code: Option<&str>,
) -> StoreResult<Retried> {
    // Select failed jobs, oldest first.
    let mut listing = Listing {
        state: Some(State::Failed),
        order: Order::OldestFirst,
        limit: PAGE,
        ..listing
    };
    let mut retried = Retried::default();
    loop {
        let page = store.list(visibility, &listing).await?;
        for job in &page {
            // The code is no filter of the store, so it is compared here.
            let failure = job.failure.as_ref().map(|failure| failure.code.as_str());
            if code.is_some() && failure != code {
                continue;
            }
            // Requeue the job. A job that has not failed any more is left alone.
            let again = Transition::Commanded(Command::Retry);
            if let Changed::Yes(job) = store.change(visibility, job.id, &again).await? {
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
    /// Retries failed jobs and notifies watchers; see [`retry_failed`].
    pub async fn retry_failed(
        &self,
        visibility: &Visibility,
        listing: Listing,
        code: Option<&str>,
    ) -> StoreResult<Retried> {
        let retried = retry_failed(self.store.as_ref(), visibility, listing, code).await?;
        for job in &retried.jobs {
            self.tell(job).await;
        }
        Ok(retried)
    }
}
