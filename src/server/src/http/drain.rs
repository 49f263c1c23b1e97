//! Draining of a process before it is stopped.

use axum::Json;
use axum::extract::State;
use serde::Serialize;

use super::app::{App, Shared};

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
