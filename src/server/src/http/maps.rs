//! Maps of charts while they relax.

use std::time::Duration;

use axum::extract::State as Extracted;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

use super::app::Shared;
use super::extract::{Parameters, PathId};
use super::missing::missing;
use super::problem::{Code, Problem};
use crate::jobs::access::Caller;
use crate::jobs::{NextMaps, State, Subscription};

/// Maximum wait for a frame. It stays below the timeouts of common proxies, such as the 60 s of nginx; shorter waits
/// mean more requests while nothing moves.
const PATIENCE: Duration = Duration::from_secs(20);

/// Which frame.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct MapsQuery {
    /// The number of the last frame received; without it, any frame is new.
    after: Option<u64>,
}

/// Watch charts relax.
///
/// The answer is one frame with the charts that moved since the former one, as the solver has them.
/// It is sent as soon as there is one; a client that asks again with its number in `after` sees
/// about ten frames a second, and fewer where they are large. Frames are made only while somebody
/// asks, by jobs of the kind `unwrap`. A slow client misses frames in between. `live.md` beside
/// this document describes the bytes.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/maps", operation_id = "watchMaps", tag = "jobs",
    params(("id" = String, Path, format = "uuid", description = "The job"), MapsQuery),
    responses(
        (status = 200, description = "A frame", content_type = "application/octet-stream"),
        (status = 204, description = "No chart moved for 20 seconds, or the job has ended"),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`computed_elsewhere`: another process computes the job, and only that has its maps", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn watch_maps(
    Extracted(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    Parameters(query): Parameters<MapsQuery>,
) -> Result<Response, Problem> {
    // Subscribe to the job.
    let visibility = caller.visibility();
    let Some(events) = app.jobs.subscribe(&visibility, id).await? else {
        return Err(missing(&app, &visibility, id).await);
    };
    // Wait for the next frame of the running attempt, or for an end.
    let next = async {
        if is_running(events).await {
            app.jobs.next_maps(id, query.after.unwrap_or(0)).await
        } else {
            NextMaps::Over
        }
    };
    let next = tokio::select! {
        next = next => next,
        () = tokio::time::sleep(PATIENCE) => NextMaps::Over,
        () = app.stop.cancelled() => NextMaps::Over,
        () = app.keys.lapsed(&caller) => NextMaps::Over,
    };
    match next {
        NextMaps::Frame(bytes) => {
            let of_bytes = [(header::CONTENT_TYPE, "application/octet-stream")];
            Ok((of_bytes, bytes).into_response())
        }
        NextMaps::Over => Ok(StatusCode::NO_CONTENT.into_response()),
        NextMaps::Elsewhere => {
            let detail = "ask the process that computes it, or wait for the result";
            Err(Problem::new(Code::ComputedElsewhere, detail))
        }
    }
}

/// Waits until a job runs. Returns `false` if it has ended.
async fn is_running(mut events: Subscription) -> bool {
    while let Some(event) = events.next().await {
        match event.state {
            State::Queued => {}
            state => return state == State::Running,
        }
    }
    false
}
