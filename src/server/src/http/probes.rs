//! Operational routes: health, readiness, metrics, the OpenAPI document.

use std::sync::OnceLock;

use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;

use super::app::Shared;
use super::assets::{self, Asset};
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
///
/// It does when records can be written, the place for files is that of the service and takes more,
/// the disks have as much free space as the service asks for, and the quota is not used up.
#[utoipa::path(
    get, path = "/readyz", operation_id = "readyz", tag = "service",
    responses(
        (status = 200, description = "The service accepts jobs", body = String, content_type = "text/plain"),
        (status = 503, description = "`not_ready`, with the reason; `stopping`, `draining`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn readyz(State(app): Shared) -> Result<&'static str, Problem> {
    if app.stop.is_cancelled() {
        return Err(Problem::new(
            Code::Stopping,
            "the service accepts no new jobs",
        ));
    }
    if app.jobs.is_draining() {
        return Err(Problem::new(Code::Draining, "DELETE /v1/drain ends that"));
    }
    match app.jobs.check().await {
        Ok(()) => Ok("ready\n"),
        Err(error) => Err(Problem::new(Code::NotReady, error.to_string())),
    }
}

/// Get metrics in the Prometheus text format.
///
/// They are those of this process, and the state of the store, which is the same for all. While the
/// job database does not answer, `unwrapd_store_up` is 0, and while files cannot be stored,
/// `unwrapd_blobs_up` is. `serve` and `worker` can also show them
/// without a key, at an address of its own (`--metrics-listen`).
#[utoipa::path(
    get, path = "/metrics", operation_id = "metrics", tag = "service",
    responses(
        (status = 200, description = "What is measured", body = String, content_type = "text/plain"),
    )
)]
pub(super) async fn metrics(State(app): Shared) -> Response {
    app.exposition.answer().await
}

/// Get this document.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "openapi", tag = "service",
    responses(
        (status = 200, description = "OpenAPI 3.1", body = Object, content_type = "application/json"),
        (status = 304, description = "The document is unchanged"),
    )
)]
pub(super) async fn openapi_document(State(app): Shared, headers: HeaderMap) -> Response {
    static DOCUMENT: OnceLock<Asset> = OnceLock::new();
    let document = DOCUMENT.get_or_init(|| {
        let text = super::openapi(app.jobs.settings().catalog);
        Asset::new("application/json", text.leak().as_bytes())
    });
    assets::answer(document, None, &headers)
}
