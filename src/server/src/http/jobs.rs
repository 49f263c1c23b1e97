//! Routes of jobs: create, get, list, change, cancel, finish, try again.
//!
//! Creation comes first, from the upload to the response.

use std::time::Duration;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};

use super::app::{App, Shared, json};
use super::extract::{MAX_WAIT_SECONDS, Parameters, PathId, existing, missing, preferred_wait};
use super::input::{self, Defaults, JobFile};
use super::problem::{Code, Problem};
use super::submission::{SubmissionHeaders, metadata};
use super::view::{JobPage, JobView, job_path};
use crate::jobs::access::{Caller, Owner, Visibility};
use crate::jobs::{
    Changed, Command, Ended, Job, JobId, Listing, Metadata, Order, OwnerQuota, Reason, Refusal,
    State as JobState, SubmitError, Submitted, Timestamp, Webhook,
};
use crate::webhooks;
use unwrapd_api::Kind;

/// A job unwraps the input of the job that its query names, unless the query says otherwise.
const DEFAULTS: Defaults = Defaults {
    kind: Kind::Unwrap,
    file: JobFile::Input,
};

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
/// Instead of an upload, the query parameter `job` takes the files of an earlier job, to compute them
/// again with other options; `file` says which. All options are query parameters then.
///
/// `unwrap`, `repack`, `measure`, `verify`, `edit_uv` and `texture_map` read glTF, OBJ, OFF, PLY
/// and STL. `deform` also reads Gmsh, Medit and TET meshes, and PNG and SVG outlines. `untangle` reads
/// OBJ, OFF, Gmsh, Medit and TET meshes. `warp` reads PNG, JPEG and `WebP`. `solve` reads a problem
/// file with its mesh beside it.
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
        ("kind" = Option<Kind>, Query, description = "Kind of job; the default is `unwrap`"),
        ("filename" = Option<String>, Query, description = "File name of a raw body"),
        ("job" = Option<String>, Query, format = "uuid", description = "The job to take the input from; it may still run, but not be cancelled. There is no body then"),
        ("file" = Option<JobFile>, Query, description = "With `job`: the files to take; the default is `input`"),
        ("priority" = Option<i32>, Query, minimum = -100, maximum = 100, description = "Of the waiting jobs of one owner, those of higher priority start first; the default is 0"),
        ("metadata" = Option<String>, Query, description = "JSON object of at most 4096 bytes and 64 members, which is repeated wherever the job is shown. `listJobs` finds jobs by it"),
        ("accept" = Option<String>, Query, description = "Gates that the result has to meet, as a list with commas: `certified`, `max_charts=N`, `max_distortion=E` (mean symmetric Dirichlet energy of the worst atlas; `max_symmetric_dirichlet` is the same), `max_stretch=S` (99th percentile), `max_seconds=T`, `written`. `accepted` of the job says whether it does"),
        ("webhook" = Option<String>, Query, description = "Address to which the end of the job is posted, signed as Standard Webhooks says, until it answers 2xx"),
    ),
    responses(
        (status = 202, description = "The accepted job", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 200, description = "The job, which ended while the request waited", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 400, description = "`invalid_request`, `invalid_options`, `missing_mesh`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`: of `job`", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "`request_timeout`: the body paused for too long, or took too long", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`, `no_result`: `job` was cancelled, or has no result", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`: of `job`", body = Problem, content_type = "application/problem+json"),
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
    let received = input::receive(&app, &caller, request, DEFAULTS).await?;
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
    let Some(reachable) = app.settings.webhooks else {
        let why = "this service sends none: it has no --webhook-secret";
        return Err(bad_webhook(&why));
    };
    webhooks::check(webhook, reachable).map_err(|error| bad_webhook(&error))
}

fn bad_webhook(why: &dyn std::fmt::Display) -> Problem {
    Problem::new(Code::InvalidRequest, format!("`webhook`: {why}"))
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

// Routes for reading and ending jobs.

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

/// Query for a change of a job.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct ChangeQuery {
    /// JSON object of at most 4096 bytes and 64 members, in place of the present metadata.
    metadata: String,
}

/// Change the metadata of a job.
///
/// The new metadata replaces all of the old, in any state of the job, and `listJobs` finds the job by it
/// from then on. What the job computes stays as it is, and so does what an `Idempotency-Key` has to
/// repeat. Repeating the call is harmless.
#[utoipa::path(
    patch, path = "/v1/jobs/{id}", operation_id = "changeJob", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job"), ChangeQuery),
    responses(
        (status = 200, description = "The job", body = JobView),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn change_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    Parameters(query): Parameters<ChangeQuery>,
) -> Result<Response, Problem> {
    let visibility = caller.visibility();
    let metadata = metadata(&query.metadata)?;
    match app.jobs.note(&visibility, id, metadata).await? {
        Changed::Yes(job) => Ok(json(StatusCode::OK, &view(&app, &job))),
        // No state of a job refuses metadata.
        Changed::No(..) | Changed::Missing => Err(missing(&app, &visibility, id).await),
    }
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

// The list of jobs.

/// Default and maximum number of jobs per page, by convention. The OpenAPI document repeats them. Larger pages mean
/// fewer requests but slower responses.
const DEFAULT_PAGE: u32 = 50;
const MAX_PAGE: u32 = 200;

/// Query for a list of jobs.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct ListQuery {
    /// Only jobs in this state.
    state: Option<JobState>,
    /// Only jobs of this kind.
    kind: Option<Kind>,
    /// Only jobs of this owner; empty for those made without a key.
    owner: Option<String>,
    /// Only jobs whose metadata has these members with these values, as a JSON object.
    metadata: Option<String>,
    /// Only jobs with all of these words in the name of their input, in `name` or `path` of their metadata, or in their
    /// tags, which are members of the metadata that are `true`. Case does not matter.
    search: Option<String>,
    /// Only jobs accepted at this time or later.
    #[param(format = "date-time")]
    created_from: Option<String>,
    /// Only jobs accepted before this time.
    #[param(format = "date-time")]
    created_before: Option<String>,
    /// Order of the jobs; the default is `newest_first`.
    order: Option<Order>,
    /// Maximum number of jobs; the default is 50.
    #[param(minimum = 1, maximum = 200)]
    limit: Option<u32>,
    /// `next` of the previous page.
    #[param(format = "uuid")]
    cursor: Option<String>,
}

/// Query for failed jobs to try again.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct RetryQuery {
    /// Only jobs that failed with this code, such as `worker_lost`.
    code: Option<String>,
    /// Only jobs of this kind.
    kind: Option<Kind>,
    /// Only jobs of this owner; empty for those made without a key.
    owner: Option<String>,
    /// Only jobs whose metadata has these members with these values, as a JSON object.
    metadata: Option<String>,
    /// Only jobs accepted at this time or later.
    #[param(format = "date-time")]
    created_from: Option<String>,
    /// Only jobs accepted before this time.
    #[param(format = "date-time")]
    created_before: Option<String>,
    /// `next` of the previous answer.
    #[param(format = "uuid")]
    cursor: Option<String>,
}

/// Failed jobs that are queued again.
#[derive(Serialize, utoipa::ToSchema)]
struct RetriedJobs {
    /// Number of jobs.
    retried: usize,
    /// Their ids, the oldest first.
    #[schema(value_type = Vec<String>)]
    jobs: Vec<JobId>,
    /// The `cursor` that goes on after them, if there may be more.
    #[schema(value_type = Option<String>)]
    next: Option<JobId>,
}

impl ListQuery {
    /// Returns the listing for the query, with one job more than a page has.
    fn listing(self, limit: u32) -> Result<Listing, Problem> {
        if !(1..=MAX_PAGE).contains(&limit) {
            return Err(invalid(format!("`limit` must be between 1 and {MAX_PAGE}")));
        }
        let cursor = self.cursor.map(|cursor| cursor.parse()).transpose();
        let owner = self.owner.map(|owner| match owner.as_str() {
            "" => Ok(Owner::default()),
            name => name.parse(),
        });
        let owner = owner.transpose();
        Ok(Listing {
            state: self.state,
            kind: self.kind,
            owner: owner.map_err(|error| invalid(format!("`owner`: {error}")))?,
            metadata: self
                .metadata
                .map_or_else(|| Ok(Metadata::default()), |text| metadata(&text))?,
            words: words(&self.search.unwrap_or_default()),
            since: time("created_from", self.created_from)?,
            until: time("created_before", self.created_before)?,
            order: self.order.unwrap_or_default(),
            after: cursor.map_err(|_| invalid("`cursor` is not the `next` of a page"))?,
            limit: limit + 1,
        })
    }
}

fn invalid(detail: impl Into<String>) -> Problem {
    Problem::new(Code::InvalidRequest, detail)
}

/// Returns the words of a text in lower case.
fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_lowercase).collect()
}

/// Parses a time in RFC 3339.
fn time(name: &str, text: Option<String>) -> Result<Option<Timestamp>, Problem> {
    let parsed = text
        .map(|text| humantime::parse_rfc3339_weak(&text))
        .transpose();
    let parsed = parsed.map_err(|error| {
        invalid(format!(
            "`{name}` is no time such as 2026-12-31T23:59:59Z: {error}"
        ))
    })?;
    Ok(parsed.map(Timestamp::from))
}

/// List jobs, with filters.
///
/// All filters must be met. A page has the `cursor` of the next one, which needs the same filters
/// and the same order.
#[utoipa::path(
    get, path = "/v1/jobs", operation_id = "listJobs", tag = "jobs", params(ListQuery),
    responses(
        (status = 200, description = "A page of jobs", body = JobPage),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn list_jobs(
    State(app): Shared,
    caller: Caller,
    Parameters(query): Parameters<ListQuery>,
) -> Result<Response, Problem> {
    let limit = query.limit.unwrap_or(DEFAULT_PAGE);
    let listing = query.listing(limit)?;
    let mut jobs = app.jobs.list(&caller.visibility(), &listing).await?;
    let is_last = jobs.len() <= limit as usize;
    jobs.truncate(limit as usize);
    let next = jobs
        .last()
        .filter(|_| !is_last)
        .map(|job| job.id.to_string());
    let jobs = jobs.iter().map(|job| view(&app, job)).collect();
    Ok(json(StatusCode::OK, &JobPage { jobs, next }))
}

/// Try failed jobs again, with filters.
///
/// All filters must be met. Each job is queued with its input and its options, under the same id, as
/// by `POST /v1/jobs/{id}/retry`. One call tries up to 1000 jobs, the oldest first; `next` is the
/// `cursor` for more. Repeating a call is harmless: jobs that have not failed are left alone.
#[utoipa::path(
    post, path = "/v1/jobs/retry", operation_id = "retryJobs", tag = "jobs", params(RetryQuery),
    responses(
        (status = 202, description = "The jobs that are queued again", body = RetriedJobs),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn retry_jobs(
    State(app): Shared,
    caller: Caller,
    Parameters(query): Parameters<RetryQuery>,
) -> Result<Response, Problem> {
    // Translate the query to that of a list of failed jobs.
    let code = query.code.clone();
    let query = ListQuery {
        state: None,
        kind: query.kind,
        owner: query.owner,
        metadata: query.metadata,
        search: None,
        created_from: query.created_from,
        created_before: query.created_before,
        order: None,
        limit: None,
        cursor: query.cursor,
    };
    let listing = query.listing(DEFAULT_PAGE)?;
    // Requeue them.
    let retried = app
        .jobs
        .retry_failed(&caller.visibility(), listing, code.as_deref())
        .await?;
    let jobs: Vec<JobId> = retried.jobs.iter().map(|job| job.id).collect();
    let answer = RetriedJobs {
        retried: jobs.len(),
        jobs,
        next: retried.next,
    };
    Ok(json(StatusCode::ACCEPTED, &answer))
}
