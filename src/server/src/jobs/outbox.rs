//! Ends of jobs that are still to be told.

use std::time::Duration;

use futures_util::future::BoxFuture;
use serde_json::json;
use uuid::Uuid;

use super::access::Owner;
use super::job::Job;
use super::store_error::StoreResult;
use super::webhook::Webhook;

/// The end of a job, which is to be told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Names it, however often it is told.
    pub id: String,
    /// Whose the job is.
    pub owner: Owner,
    /// Where to.
    pub webhook: Webhook,
    /// What: a JSON object.
    pub body: String,
    /// How often that was tried, this time included.
    pub attempt: u32,
}

impl Notice {
    /// That of a job which has just ended, if somebody wants to know.
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
                "certified": job.verdict.worth.certified,
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

/// Notices that are still to be told. They are recorded in the transaction in which a job ends, and
/// stay until they are settled.
pub trait Outbox: Send + Sync {
    /// Takes at most so many notices whose time has come. Nobody else gets them for this time, and
    /// after it they come again.
    fn take(&self, most: u32, lease: Duration) -> BoxFuture<'_, StoreResult<Vec<Notice>>>;

    /// Forgets a notice: it was told, or nobody will hear it.
    fn settle<'a>(&'a self, id: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Has a notice come again after this time.
    fn defer<'a>(&'a self, id: &'a str, pause: Duration) -> BoxFuture<'a, StoreResult<()>>;
}
