//! Job creation, from the upload to the response.

use std::time::Duration;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::Response;

use super::app::{App, Shared, json};
use super::extract::preferred_wait;
use super::jobs::{view, wait_for};
use super::problem::{Code, Problem};
use super::submission_headers::SubmissionHeaders;
use super::upload;
use super::view::{JobView, job_path};
use crate::jobs::access::Caller;
use crate::jobs::{Ended, Job, OwnerQuota, SubmitError, Submitted, Webhook};
use crate::webhooks;

/// Create a job of any kind.
///
/// The input is a form or the body itself. A form has the input as `mesh`, `image` or `problem`,
/// the files it references as `resource`, `options` as JSON, and `kind`. `priority`, `metadata`,
/// `accept` and `webhook` can be parts too. Options can also be query parameters; a list is then
/// its JSON text. Each kind has options of its own, named as on the command line, in snake_case.
/// The handles of a job have the JSON form of the command line's handle files.
///
/// A ZIP can bring an input together with the files that it references. It is the body, or the part
/// of the input, and has exactly one file that the kind reads.
///
/// `unwrap`, `repack`, `measure`, `verify`, `edit_uv` and `texture_map` read glTF, OBJ, OFF, PLY
/// and STL. `deform` also reads Gmsh, Medit and TET meshes, and PNG and SVG outlines. `warp` reads
/// PNG and JPEG. `solve` reads a problem file with its mesh beside it.
///
/// When the answer is sent, the input and the job are stored. The job will succeed, fail or be
/// cancelled, even if the service crashes. Unknown formats, malformed JSON and unknown options are
/// refused immediately. Any other defect of the input fails the job with a code of `x-problems`.
///
/// A job whose kind, options and input equal those of an earlier one of its owner gets a copy of
/// its result and is marked `cached`. `Cache-Control: no-cache` asks for a new computation.
///
/// With `Idempotency-Key`, a repetition within a day returns the same job. It must agree in input,
/// kind, options, metadata, gates and webhook. Once the job is deleted, the key makes a new one.
/// With `Prefer: wait=N`,
/// the answer waits up to N seconds, at most 60. It is 200 if the job has ended by then. Progress
/// is under `/events`, the result under `/result` and `/report`. Ended jobs are removed with their
/// files after 30 days, or after the configured time.
#[utoipa::path(
    post, path = "/v1/jobs", operation_id = "createJob", tag = "jobs",
    params(
        ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 255, description = "The client's own name for this submission, at most 255 characters"),
        ("Cache-Control" = Option<String>, Header, description = "`no-cache`: compute the result even if an equal job has one"),
        ("Prefer" = Option<String>, Header, description = "`wait=N`: answer when the job has ended, but after N seconds at the latest"),
        ("kind" = Option<unwrapd_api::Kind>, Query, description = "Kind of job; the default is `unwrap`"),
        ("filename" = Option<String>, Query, description = "File name of a raw body"),
        ("priority" = Option<i32>, Query, minimum = -100, maximum = 100, description = "Of the waiting jobs of one owner, those of higher priority start first; the default is 0"),
        ("metadata" = Option<String>, Query, description = "JSON object of at most 4096 bytes and 64 members, which is repeated wherever the job is shown. `listJobs` finds jobs by it"),
        ("accept" = Option<String>, Query, description = "Gates that the result has to meet, as a list with commas: `certified`, `max_charts=N`, `max_distortion=E` (mean symmetric Dirichlet energy of the worst atlas; `max_symmetric_dirichlet` is the same), `max_stretch=S` (99th percentile), `max_seconds=T`, `written`. `accepted` of the job says whether it does"),
        ("webhook" = Option<String>, Query, description = "Address to which the end of the job is posted, signed as Standard Webhooks says, until it answers 2xx"),
    ),
    responses(
        (status = 202, description = "The accepted job", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 200, description = "The job, which ended while the request waited", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 400, description = "`invalid_request`, `invalid_options`, `missing_mesh`", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "`request_timeout`: the body paused for too long, or took too long", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "`upload_too_large`", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "`unsupported_media_type`", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "`unknown_format`, `invalid_archive`, `invalid_gltf`, `bad_parameter`, `idempotency_key_reused`", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "`owner_quota_used`: jobs, bytes or processor time of the owner", body = Problem, content_type = "application/problem+json"),
        (status = 503, description = "`queue_full`, `store_unavailable`: try again later; `draining`: try again elsewhere", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "`storage_full`: delete jobs, or try again later", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn create_job(
    State(app): Shared,
    caller: Caller,
    headers: HeaderMap,
    request: Request,
) -> Result<Response, Problem> {
    // Receive the upload, and check its headers and its webhook.
    let submission_headers = SubmissionHeaders::read(&headers)?;
    let received = upload::receive(&app, None, request).await?;
    if let Some(webhook) = &received.handling.webhook {
        check_webhook(&app, webhook)?;
    }
    // Store and queue the job.
    let (submission, _folder) = received.into_submission(caller.owner(), submission_headers, false);
    let job = match app.jobs.submit(submission).await? {
        Submitted::New(job) | Submitted::Replay(job) => job,
    };
    // Wait for its end if the client prefers that.
    let Some(wait) = preferred_wait(&headers) else {
        return Ok(located(&app, StatusCode::ACCEPTED, &job));
    };
    let mut response = match wait_for(&app, &caller.visibility(), job.id, wait).await? {
        Ended::Yes(job) => located(&app, StatusCode::OK, &job),
        Ended::NotYet(job) => located(&app, StatusCode::ACCEPTED, &job),
    };
    let applied = format!("wait={}", wait.as_secs());
    if let Ok(applied) = HeaderValue::from_str(&applied) {
        response.headers_mut().insert("preference-applied", applied);
    }
    Ok(response)
}

/// Rejects webhooks that would not be delivered.
fn check_webhook(app: &App, webhook: &Webhook) -> Result<(), Problem> {
    let refused = |why: String| Problem::new(Code::InvalidRequest, format!("`webhook`: {why}"));
    let no_secret = || refused("this service sends none: it has no --webhook-secret".to_owned());
    let reachable = app.settings.webhooks.ok_or_else(no_secret)?;
    webhooks::check(webhook, reachable).map_err(|error| refused(error.to_string()))
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        match error {
            SubmitError::QueueFull(after) => {
                Self::new(Code::QueueFull, "try again later").retried_after(whole_seconds(after))
            }
            SubmitError::OwnerQuota(quota, after) => {
                let detail = match quota {
                    OwnerQuota::Jobs => "too many of its jobs wait or run",
                    OwnerQuota::Bytes => "its jobs would take too many bytes: delete some",
                    OwnerQuota::Cpu => "its processor time of this day is used up",
                };
                Self::new(Code::OwnerQuotaUsed, detail).retried_after(whole_seconds(after))
            }
            SubmitError::KeyReused => Self::new(
                Code::IdempotencyKeyReused,
                "the mesh, kind or options differ from the first submission",
            ),
            SubmitError::Store(error) => error.into(),
        }
    }
}

fn whole_seconds(time: Duration) -> u64 {
    time.as_millis().div_ceil(1000) as u64
}

pub(super) fn located(app: &App, status: StatusCode, job: &Job) -> Response {
    let mut response = json(status, &view(app, job));
    if let Ok(path) = HeaderValue::from_str(&job_path(&app.settings.base_path, job)) {
        response.headers_mut().insert(header::LOCATION, path);
    }
    response
}
