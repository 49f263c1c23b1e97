//! Routes for reading and ending jobs.

use std::time::Duration;

use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

use super::app::{App, Shared, json};
use super::extract::{MAX_WAIT_SECONDS, Parameters, PathId};
use super::missing::{existing, missing};
use super::problem::{Code, Problem};
use super::view::JobView;
use crate::jobs::access::{Caller, Visibility};
use crate::jobs::{Changed, Command, Ended, Job, JobId, Reason, Refusal};

/// Query for a job.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct GetQuery {
    /// Answer when the job has ended, but after this many seconds at the latest.
    #[param(minimum = 0, maximum = 60)]
    wait: Option<u64>,
}

/// Get a job: its state, its progress and the paths of its files.
#[utoipa::path(
    get, path = "/v1/jobs/{id}", operation_id = "getJob", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job"), GetQuery),
    responses(
        (status = 200, description = "The job", body = JobView),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    Parameters(query): Parameters<GetQuery>,
) -> Result<Response, Problem> {
    let wait = query.wait.unwrap_or(0);
    if MAX_WAIT_SECONDS < wait {
        let detail = format!("`wait` must be between 0 and {MAX_WAIT_SECONDS}");
        return Err(Problem::new(Code::InvalidRequest, detail));
    }
    let visibility = caller.visibility();
    let job = if wait == 0 {
        existing(&app, &visibility, id).await?
    } else {
        match wait_for(&app, &visibility, id, Duration::from_secs(wait)).await? {
            Ended::Yes(job) | Ended::NotYet(job) => job,
        }
    };
    Ok(json(StatusCode::OK, &view(&app, &job)))
}

/// Cancel a live job, or delete one that has ended.
///
/// Cancelling a live job ends its computation immediately and keeps only its record. A job that has
/// ended is removed with all its files.
#[utoipa::path(
    delete, path = "/v1/jobs/{id}", operation_id = "deleteJob", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 202, description = "The live job, which is being cancelled", body = JobView),
        (status = 204, description = "The job had ended and is removed"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn delete_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
) -> Result<Response, Problem> {
    let visibility = caller.visibility();
    if app.jobs.remove(&visibility, id, Reason::Deleted).await? {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let (job, _) = send_command(&app, &visibility, id, Command::Cancel).await?;
    Ok(json(StatusCode::ACCEPTED, &view(&app, &job)))
}

/// Finish a live job early.
///
/// The job stops improving the map. It writes, judges and reports the current one, which is valid like
/// every map on the way. A queued job does so as soon as it starts.
#[utoipa::path(
    post, path = "/v1/jobs/{id}/finish", operation_id = "finishJob", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 202, description = "The job, which is finishing", body = JobView),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`already_finished`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn finish_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
) -> Result<Response, Problem> {
    let (job, refusal) = send_command(&app, &caller.visibility(), id, Command::FinishEarly).await?;
    if refusal.is_some() {
        let detail = format!("its state is {}", job.state.word());
        return Err(Problem::new(Code::AlreadyFinished, detail));
    }
    Ok(json(StatusCode::ACCEPTED, &view(&app, &job)))
}

/// Try a failed job again.
///
/// The job is queued with its input and its options, under the same id. Its error is forgotten.
/// `GET /v1/jobs?state=failed` lists the failed jobs with their errors.
#[utoipa::path(
    post, path = "/v1/jobs/{id}/retry", operation_id = "retryJob", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 202, description = "The job, which is queued", body = JobView),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_failed`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn retry_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
) -> Result<Response, Problem> {
    let (job, refusal) = send_command(&app, &caller.visibility(), id, Command::Retry).await?;
    if refusal.is_some() {
        let detail = format!("the job is {}", job.state.word());
        return Err(Problem::new(Code::NotFailed, detail));
    }
    Ok(json(StatusCode::ACCEPTED, &view(&app, &job)))
}

/// Applies a command to a job. Returns the job and the reason if the command was rejected.
async fn send_command(
    app: &App,
    visibility: &Visibility,
    id: JobId,
    command: Command,
) -> Result<(Job, Option<Refusal>), Problem> {
    match app.jobs.command(visibility, id, command).await? {
        Changed::Yes(job) => Ok((*job, None)),
        Changed::No(job, refusal) => Ok((*job, Some(refusal))),
        Changed::Missing => Err(missing(app, visibility, id).await),
    }
}

/// Returns the public view of a job.
pub(super) fn view(app: &App, job: &Job) -> JobView {
    JobView::new(job, app.jobs.settings(), &app.settings.base_path)
}

/// Waits for the end of a job, or for the stop of the service.
pub(super) async fn wait_for(
    app: &App,
    visibility: &Visibility,
    id: JobId,
    wait: Duration,
) -> Result<Ended, Problem> {
    let ended = tokio::select! {
        ended = app.jobs.wait(visibility, id, wait) => ended?,
        () = app.stop.cancelled() => app.jobs.get(visibility, id).await?.map(Ended::NotYet),
    };
    match ended {
        Some(ended) => Ok(ended),
        None => Err(missing(app, visibility, id).await),
    }
}
