//! For those who run the service.

use std::fmt::Write;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::Shared;
use super::problem::{Code, Problem};

/// Check whether the process responds.
#[utoipa::path(
    get, path = "/healthz", operation_id = "healthz", tag = "service",
    responses((status = 200, description = "The process responds", body = String, content_type = "text/plain"))
)]
pub(super) async fn healthz() -> &'static str {
    "ok\n"
}

/// Check whether the service accepts jobs.
#[utoipa::path(
    get, path = "/readyz", operation_id = "readyz", tag = "service",
    responses(
        (status = 200, description = "The service accepts jobs", body = String, content_type = "text/plain"),
        (status = 500, description = "`internal_error`: the job database failed", body = Problem, content_type = "application/problem+json"),
        (status = 503, description = "`stopping`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn readyz(State(app): Shared) -> Result<&'static str, Problem> {
    app.jobs.counts().await?;
    if app.stop.is_cancelled() {
        return Err(Problem::new(
            Code::Stopping,
            "the service accepts no new jobs",
        ));
    }
    Ok("ready\n")
}

/// Get metrics in the Prometheus text format.
#[utoipa::path(
    get, path = "/metrics", operation_id = "metrics", tag = "service",
    responses(
        (status = 200, description = "Jobs by state", body = String, content_type = "text/plain"),
        (status = 500, description = "`internal_error`: the job database failed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn metrics(State(app): Shared) -> Result<Response, Problem> {
    let mut text = String::from(
        "# HELP unwrapd_jobs Jobs in the store by state.\n# TYPE unwrapd_jobs gauge\n",
    );
    for (state, count) in app.jobs.counts().await? {
        let _ = writeln!(text, "unwrapd_jobs{{state=\"{}\"}} {count}", state.word());
    }
    let content_type = [(header::CONTENT_TYPE, "text/plain; version=0.0.4")];
    Ok((content_type, text).into_response())
}

/// Get this document.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "openapi", tag = "service",
    responses((status = 200, description = "OpenAPI 3.1", body = Object, content_type = "application/json"))
)]
pub(super) async fn openapi_document() -> Response {
    let content_type = [(header::CONTENT_TYPE, "application/json")];
    (content_type, super::openapi()).into_response()
}
