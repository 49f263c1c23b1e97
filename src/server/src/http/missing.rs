//! Jobs that do not exist, no longer exist or belong to another owner; callers cannot tell which.

use super::app::App;
use super::problem::{Code, Problem};
use crate::jobs::access::Visibility;
use crate::jobs::{Job, JobId};

/// Returns a job, or the problem of a missing one.
pub(super) async fn existing(
    app: &App,
    visibility: &Visibility,
    id: JobId,
) -> Result<Job, Problem> {
    match app.jobs.get(visibility, id).await? {
        Some(job) => Ok(job),
        None => Err(missing(app, visibility, id).await),
    }
}

/// Returns the problem of a missing job.
pub(super) async fn missing(app: &App, visibility: &Visibility, id: JobId) -> Problem {
    match app.jobs.has_expired(visibility, id).await {
        Ok(true) => Problem::new(Code::JobExpired, "it was removed when its time was over"),
        Ok(false) => job_not_found(),
        Err(error) => error.into(),
    }
}

/// Returns the problem of an unknown id.
pub(super) fn job_not_found() -> Problem {
    Problem::new(
        Code::JobNotFound,
        "it never existed, or it has been deleted",
    )
}
