//! Pausing the queue.

use axum::Json;
use axum::extract::State;
use serde::Serialize;

use super::app::{App, Shared};
use super::problem::Problem;

/// State of the queue for all processes.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct Pause {
    /// `true` if no process starts waiting jobs.
    paused: bool,
}

async fn set(app: &App, paused: bool) -> Result<Json<Pause>, Problem> {
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
    set(&app, true).await
}

/// Resume the queue.
///
/// Waiting jobs are started again. `unwrapd queue resume` does the same.
#[utoipa::path(
    delete, path = "/v1/pause", operation_id = "resumeQueue", tag = "service",
    responses((status = 200, description = "Waiting jobs are started", body = Pause))
)]
pub(super) async fn resume_queue(State(app): Shared) -> Result<Json<Pause>, Problem> {
    set(&app, false).await
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
