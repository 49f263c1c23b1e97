//! Operational routes: health, readiness, metrics, draining, pausing.

use axum::Json;
use axum::extract::State;
use axum::response::Response;
use serde::Serialize;

use super::app::{App, Shared};
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

// Draining of a process before it is stopped.

/// State of draining, and the work that is left.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct Drain {
    /// `true` if the process refuses new jobs and starts no waiting ones.
    draining: bool,
    /// Number of jobs that it computes now.
    running: usize,
}

impl Drain {
    fn of(app: &App) -> Json<Self> {
        Json(Self {
            draining: app.jobs.is_draining(),
            running: app.jobs.running(),
        })
    }
}

/// Drain this process.
///
/// From now on it refuses new jobs with `draining`, `/readyz` answers 503, and waiting jobs are not
/// started. Running jobs end as usual, and the process removes no expired ones. When `running` is 0,
/// the process can be stopped without handing a job back. Other processes are not affected: workers
/// drain on SIGTERM.
#[utoipa::path(
    put, path = "/v1/drain", operation_id = "startDrain", tag = "service",
    responses((status = 200, description = "The process is draining", body = Drain))
)]
pub(super) async fn start_drain(State(app): Shared) -> Json<Drain> {
    app.jobs.set_draining(true);
    Drain::of(&app)
}

/// Stop draining this process.
///
/// It accepts and starts jobs again.
#[utoipa::path(
    delete, path = "/v1/drain", operation_id = "endDrain", tag = "service",
    responses((status = 200, description = "The process accepts jobs", body = Drain))
)]
pub(super) async fn end_drain(State(app): Shared) -> Json<Drain> {
    app.jobs.set_draining(false);
    Drain::of(&app)
}

/// Check whether this process is draining, and how many jobs it still computes.
#[utoipa::path(
    get, path = "/v1/drain", operation_id = "getDrain", tag = "service",
    responses((status = 200, description = "The state of the process", body = Drain))
)]
pub(super) async fn get_drain(State(app): Shared) -> Json<Drain> {
    Drain::of(&app)
}

// Pausing the queue.

/// State of the queue for all processes.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct Pause {
    /// `true` if no process starts waiting jobs.
    paused: bool,
}

async fn set_paused(app: &App, paused: bool) -> Result<Json<Pause>, Problem> {
    app.jobs.set_paused(paused).await?;
    Ok(Json(Pause { paused }))
}

/// Pause the queue.
///
/// From now on no process starts a waiting job. Jobs are accepted, and running ones end as usual.
/// Synchronous calls wait as well. `unwrapd queue pause` does the same.
#[utoipa::path(
    put, path = "/v1/pause", operation_id = "pauseQueue", tag = "service",
    responses((status = 200, description = "The queue is paused", body = Pause))
)]
pub(super) async fn pause_queue(State(app): Shared) -> Result<Json<Pause>, Problem> {
    set_paused(&app, true).await
}

/// Resume the queue.
///
/// Waiting jobs are started again. `unwrapd queue resume` does the same.
#[utoipa::path(
    delete, path = "/v1/pause", operation_id = "resumeQueue", tag = "service",
    responses((status = 200, description = "Waiting jobs are started", body = Pause))
)]
pub(super) async fn resume_queue(State(app): Shared) -> Result<Json<Pause>, Problem> {
    set_paused(&app, false).await
}

/// Check whether the queue is paused.
#[utoipa::path(
    get, path = "/v1/pause", operation_id = "getPause", tag = "service",
    responses((status = 200, description = "The state of the queue", body = Pause))
)]
pub(super) async fn get_pause(State(app): Shared) -> Result<Json<Pause>, Problem> {
    let paused = app.jobs.is_paused().await?;
    Ok(Json(Pause { paused }))
}
