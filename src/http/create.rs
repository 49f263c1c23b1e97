//! Jobs: made, from an upload to the answer.

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::Response;

use super::extract::preferred_wait;
use super::jobs::wait_for;
use super::problem::{Code, Problem};
use super::upload;
use super::view::{JobView, job_path};
use super::{Shared, json};
use crate::jobs::{Ended, Job, SubmitError, Submitted};

/// Longest Idempotency-Key.
const MAX_KEY: usize = 255;

/// Make a job of any kind.
///
/// The input comes as a form (`mesh`, `image` or `problem`, the files it references, `options` as JSON, `kind`) or as the body
/// itself; options may also be query parameters, lists as their JSON text. Each kind has options of its own: the command line's
/// long names in snake_case. A file of handles that the command line takes is the JSON of such options.
///
/// `unwrap`, `repack`, `measure`, `edit_uv` and `texture_map` read glTF, OBJ, OFF, PLY and STL; `deform` these and Gmsh, Medit and
/// TET meshes, PNG and SVG outlines; `warp` PNG and JPEG; `solve` a problem file, its mesh beside it.
///
/// When the answer is sent, input and job are stored: the job will end succeeded, failed
/// or cancelled, whatever happens to the service. What is of no format that the kind reads, has malformed JSON or unknown options
/// is refused at once; everything else that is wrong with an input fails the job, with a code of `x-problems`.
///
/// With `Idempotency-Key`, a repetition within a day gets the same job instead of a second one. With `Prefer: wait=N`
/// the answer waits up to N seconds (at most 60) and is 200 if the job has ended by then. Progress is found under
/// `/events`, the result under `/result` and `/report`. Some time after its end, 30 days unless the service is set
/// otherwise, a job is removed with its files.
#[utoipa::path(
    post, path = "/v1/jobs", operation_id = "createJob", tag = "jobs",
    params(
        ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 255, description = "At most 255 characters; the client's own name for this submission"),
        ("Prefer" = Option<String>, Header, description = "`wait=N`: answer when the job has ended, but not later than in N seconds"),
        ("kind" = Option<crate::jobs::Kind>, Query, description = "What to do; `unwrap` if absent"),
        ("filename" = Option<String>, Query, description = "Name of the file in a raw body"),
    ),
    responses(
        (status = 202, description = "Accepted; the job", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 200, description = "Ended while the request waited; the job", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 400, description = "`invalid_request`, `invalid_options`, `missing_mesh`", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "`upload_too_large`", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "`unsupported_media_type`", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "`unknown_format`, `invalid_gltf`, `bad_parameter`, `idempotency_key_reused`", body = Problem, content_type = "application/problem+json"),
        (status = 503, description = "`queue_full`, `stopping`: try again later", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn create_job(
    State(app): Shared,
    headers: HeaderMap,
    request: Request,
) -> Result<Response, Problem> {
    let key = idempotency_key(&headers)?;
    let received = upload::receive(&app, None, request).await?;
    let (submission, _folder) = received.into_submission(key, false);
    let job = match app.jobs.submit(submission).await? {
        Submitted::New(job) | Submitted::Replay(job) => job,
    };
    let Some(wait) = preferred_wait(&headers) else {
        return Ok(located(StatusCode::ACCEPTED, &job));
    };
    let mut response = match wait_for(&app, job.id, wait).await? {
        Ended::Yes(job) => located(StatusCode::OK, &job),
        Ended::NotYet(job) => located(StatusCode::ACCEPTED, &job),
    };
    let applied = format!("wait={}", wait.as_secs());
    if let Ok(applied) = HeaderValue::from_str(&applied) {
        response.headers_mut().insert("preference-applied", applied);
    }
    Ok(response)
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        match error {
            SubmitError::QueueFull => Self::new(Code::QueueFull, "try again later"),
            SubmitError::KeyReused => Self::new(
                Code::IdempotencyKeyReused,
                "mesh, kind or options differ from the first time",
            ),
            SubmitError::Store(error) => error.into(),
        }
    }
}

fn idempotency_key(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let Some(value) = headers.get("idempotency-key") else {
        return Ok(None);
    };
    match value.to_str() {
        Ok(key) if (1..=MAX_KEY).contains(&key.len()) => Ok(Some(key.to_owned())),
        _ => Err(Problem::new(
            Code::InvalidRequest,
            format!("Idempotency-Key has 1 to {MAX_KEY} visible characters"),
        )),
    }
}

fn located(status: StatusCode, job: &Job) -> Response {
    let mut response = json(status, &JobView::from(job));
    if let Ok(path) = HeaderValue::from_str(&job_path(job)) {
        response.headers_mut().insert(header::LOCATION, path);
    }
    response
}
