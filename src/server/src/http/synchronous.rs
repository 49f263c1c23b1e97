//! Synchronous requests for small meshes and for textures.

use std::collections::BTreeSet;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::response::{IntoResponse, Response};

use super::app::{App, Shared};
use super::jobs::wait_for;
use super::problem::{Code, Problem};
use super::schemas::{CallProblems, DecodingProblems};
use super::submission::SubmissionHeaders;
use super::{download, upload};
use crate::jobs::access::Caller;
use crate::jobs::{Ended, Job, JobId, Jobs, State as JobState, Submitted};
use unwrapd_api::{Kind, Verdict};

const CERTIFIED: HeaderName = HeaderName::from_static("unwrapd-certified");
const WITHIN_BOUND: HeaderName = HeaderName::from_static("unwrapd-within-bound");
const WARNINGS: HeaderName = HeaderName::from_static("unwrapd-warnings");

/// Unwrap a mesh and get it back.
///
/// For meshes that take seconds. The call waits in the same queue as jobs, and nothing is kept. The
/// answer is one file, in the `format` `glb` or `obj`. The format `gltf`, the report and the
/// pictures require a job (`needs_job`). The header `unwrapd-certified` says whether everything
/// requested is proven. The header `unwrapd-within-bound` says whether the distortion keeps its
/// bound. The header `unwrapd-warnings` lists the codes of the warnings. Closing the connection
/// cancels the call.
#[utoipa::path(
    post, path = "/v1/unwrap", operation_id = "unwrap", tag = "synchronous",
    params(("filename" = Option<String>, Query, description = "File name of a raw body")),
    responses(
        (status = 200, description = "The mesh with its new UVs", headers(
            ("unwrapd-certified" = bool, description = "Whether everything requested is proven on these bytes"),
            ("unwrapd-within-bound" = bool, description = "Whether the distortion keeps its bound; absent if there is none"),
            ("unwrapd-warnings" = String, description = "Codes of the warnings; absent if there are none"),
        ), content((Vec<u8> = "model/gltf-binary"), (Vec<u8> = "model/obj"))),
        CallProblems,
    )
)]
pub(super) async fn unwrap(
    State(app): Shared,
    caller: Caller,
    request: Request,
) -> Result<Response, Problem> {
    run(&app, &caller, Kind::Unwrap, request).await
}

/// Measure the UVs of a mesh and get the report.
///
/// For meshes that take seconds. Nothing is kept. Closing the connection cancels the call.
#[utoipa::path(
    post, path = "/v1/measure", operation_id = "measure", tag = "synchronous",
    params(("filename" = Option<String>, Query, description = "File name of a raw body")),
    responses(
        (status = 200, description = "The report", body = ref("#/components/schemas/Report")),
        CallProblems,
    )
)]
pub(super) async fn measure(
    State(app): Shared,
    caller: Caller,
    request: Request,
) -> Result<Response, Problem> {
    run(&app, &caller, Kind::Measure, request).await
}

/// Convert a texture to PNG.
///
/// For pages, which cannot show KTX2: Basis Universal in ETC1S or UASTC, as glTF has it. The finest level of the
/// texture becomes a PNG. PNG, JPEG and `WebP` are read too. Nothing is kept. Closing the connection cancels the call.
#[utoipa::path(
    post, path = "/v1/decode", operation_id = "decodeTexture", tag = "synchronous",
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        DecodingProblems,
    )
)]
pub(super) async fn decode(State(app): Shared, request: Request) -> Result<Response, Problem> {
    let folder = upload::receive_texture(&app, request).await?;
    let png = app.jobs.decoded(folder.path()).await?;
    let media_type = [(header::CONTENT_TYPE, "image/png")];
    Ok((media_type, png).into_response())
}

async fn run(
    app: &Arc<App>,
    caller: &Caller,
    kind: Kind,
    request: Request,
) -> Result<Response, Problem> {
    // Ignore an idempotency key: the job is gone when the request ends.
    let submission_headers = SubmissionHeaders {
        key: None,
        ..SubmissionHeaders::read(request.headers())?
    };
    // Receive the upload and refuse results with several files.
    let received = upload::receive(app, Some(kind), request).await?;
    if received
        .options
        .get("format")
        .is_some_and(|format| format == "gltf")
    {
        let detail = "a gltf has files beside it: POST /v1/jobs, or ask for glb";
        return Err(Problem::new(Code::NeedsJob, detail));
    }
    // Queue a job that is removed when the request ends, and wait for it.
    let (submission, _folder) = received.into_submission(caller.owner(), submission_headers, true);
    let (Submitted::New(job) | Submitted::Replay(job)) = app.jobs.submit(submission).await?;
    let _guest = Guest {
        jobs: &app.jobs,
        id: job.id,
    };
    // Answer with its result, or say why there is none.
    match wait_for(
        app,
        &caller.visibility(),
        job.id,
        app.settings.synchronous_time,
    )
    .await?
    {
        Ended::Yes(job) => answer(app, &job).await,
        Ended::NotYet(_) if app.stop.is_cancelled() => {
            Err(Problem::new(Code::Stopping, "try again, or elsewhere"))
        }
        Ended::NotYet(job) => {
            let seconds = app.settings.synchronous_time.as_secs();
            let what = match job.state {
                JobState::Queued => "not begun, behind other jobs,",
                _ => "not done",
            };
            let detail = format!("{what} within {seconds} s: make it a job with POST /v1/jobs");
            Err(Problem::new(Code::TimedOut, detail).with_limit(seconds))
        }
    }
}

async fn answer(app: &App, job: &Job) -> Result<Response, Problem> {
    match (&job.failure, job.state, job.output.first()) {
        (Some(failure), _, _) => Err(Problem::of_failure(failure)),
        (None, JobState::Succeeded, Some(file)) => {
            let mut response = download::answer(
                app,
                job,
                download::StoredFile::Output(file),
                &HeaderMap::new(),
            )
            .await?;
            tell_verdict(&job.verdict, response.headers_mut());
            Ok(response)
        }
        _ => Err(Problem::new(
            Code::WorkerLost,
            "the computation was cancelled",
        )),
    }
}

/// Sets headers from the verdict of a job, which is not kept.
fn tell_verdict(verdict: &Verdict, headers: &mut HeaderMap) {
    for (name, verdict) in [
        (CERTIFIED, verdict.quality.certified),
        (WITHIN_BOUND, verdict.within_bound),
    ] {
        if let Some(verdict) = verdict {
            let verdict = if verdict { "true" } else { "false" };
            headers.insert(name, HeaderValue::from_static(verdict));
        }
    }
    let codes: BTreeSet<&str> = (verdict.warnings.iter())
        .map(|warning| warning.code.as_ref())
        .collect();
    let codes = Vec::from_iter(codes).join(", ");
    if let Ok(codes) = HeaderValue::from_str(&codes)
        && !codes.is_empty()
    {
        headers.insert(WARNINGS, codes);
    }
}

/// A job that is dismissed when its request ends, answered or not.
struct Guest<'a> {
    jobs: &'a Arc<Jobs>,
    id: JobId,
}

impl Drop for Guest<'_> {
    fn drop(&mut self) {
        self.jobs.dismiss(self.id);
    }
}
