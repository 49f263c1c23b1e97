//! Jobs that are not there, or not any more, or not for whoever asks: that is all the same to them.

use super::app::App;
use super::problem::{Code, Problem};
use crate::jobs::access::Reach;
use crate::jobs::{Job, JobId};

/// The job, or why there is none.
pub(super) async fn existing(app: &App, reach: &Reach, id: JobId) -> Result<Job, Problem> {
    match app.jobs.get(reach, id).await? {
        Some(job) => Ok(job),
        None => Err(missing(app, reach, id).await),
    }
}

/// Why there is no such job.
pub(super) async fn missing(app: &App, reach: &Reach, id: JobId) -> Problem {
    match app.jobs.has_expired(reach, id).await {
        Ok(true) => Problem::new(Code::JobExpired, "it was removed when its time was over"),
        Ok(false) => job_not_found(),
        Err(error) => error.into(),
    }
}

/// The answer to an id that is not known.
pub(super) fn job_not_found() -> Problem {
    Problem::new(
        Code::JobNotFound,
        "it never existed, or it has been deleted",
    )
}
