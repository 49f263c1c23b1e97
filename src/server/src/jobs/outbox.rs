//! Notices of ended jobs, waiting for delivery.

use std::time::Duration;

use futures_util::future::BoxFuture;
use serde_json::json;
use uuid::Uuid;

use super::access::Owner;
use super::job::Job;
use super::store_error::StoreResult;
use super::webhook::Webhook;

/// A notice that a job has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Id of the notice, the same in every delivery.
    pub id: String,
    /// Owner of the job.
    pub owner: Owner,
    /// Destination.
    pub webhook: Webhook,
    /// Content: a JSON object.
    pub body: String,
    /// Number of delivery attempts, including the current one.
    pub attempt: u32,
}

impl Notice {
    /// Returns the notice of a job that has just ended; `None` if it has no webhook or has not ended.
    pub fn of_end(job: &Job) -> Option<Self> {
        let end = job.finished.filter(|_| job.state.is_final())?;
        let body = json!({
            "type": format!("job.{}", job.state.word()),
            "timestamp": end,
            "data": {
                "id": job.id,
                "kind": job.kind,
                "state": job.state,
                "filename": job.input.first().map(|file| &file.name),
                "metadata": job.metadata,
                "certified": job.verdict.quality.certified,
                "within_bound": job.verdict.within_bound,
                "accepted": job.accepted(),
                "error": job.failure,
                "created_at": job.created,
                "started_at": job.started,
                "finished_at": end,
            },
        });
        Some(Self {
            id: format!("msg_{}", Uuid::now_v7().simple()),
            owner: job.owner.clone(),
            webhook: job.webhook.clone()?,
            body: body.to_string(),
            attempt: 0,
        })
    }
}

/// Queue of notices to be delivered. They are recorded in the transaction that ends the job, and stay until they are
/// settled.
pub trait Outbox: Send + Sync {
    /// Takes at most `most` notices that are due. Nobody else gets them during `lease`; afterwards they are due
    /// again.
    fn take(&self, most: u32, lease: Duration) -> BoxFuture<'_, StoreResult<Vec<Notice>>>;

    /// Deletes a notice that was delivered or given up.
    fn settle<'a>(&'a self, id: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Makes a notice due again after a pause.
    fn defer<'a>(&'a self, id: &'a str, pause: Duration) -> BoxFuture<'a, StoreResult<()>>;
}
