//! Watching a job: its progress events, and the maps of its charts while they relax.

use std::convert::Infallible;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::ws::{CloseFrame, Message, WebSocket, WebSocketUpgrade, close_code};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::sse::{self, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::{StreamExt, stream};
use serde::Deserialize;

use super::app::{App, Shared};
use super::extract::{Parameters, PathId, missing};
use super::problem::{Code, Problem};
use super::socket::{KEEP_ALIVE, MOST_MESSAGE_BYTES, goodbye, refusal};
use crate::jobs::access::Caller;
use crate::jobs::{NextMaps, State as JobState, Subscription};

/// Largest integer that every JSON parser represents exactly.
const MAX_SEQ: u64 = (1 << 53) - 1;

/// Query for the events of a job.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct EventsQuery {
    /// Skip events up to this `seq`; `Last-Event-ID` means the same. The final event is always sent.
    #[param(maximum = 9_007_199_254_740_991_u64)]
    after: Option<u64>,
}

/// Watch a job.
///
/// A WebSocket receives one JSON object per text message. It is closed with 1000 after the final
/// state, with 1001 when the service stops, with 1008 when the key is refused from now on, or with
/// 1009 after a message of more than 64 KiB. With `Accept: text/event-stream`, the same objects
/// arrive as server-sent events named `progress`, with `seq` as their id. Events are snapshots:
/// `seq` rises and `fraction` never falls, but a slow client misses events in between. The final
/// event is always sent, even if the job has already ended.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/events", operation_id = "watchJob", tag = "jobs",
    params(
        ("id" = String, Path, format = "uuid", description = "The job"), EventsQuery,
        ("Last-Event-ID" = Option<String>, Header, description = "`seq` of the last event received; any other value starts from the first event"),
    ),
    responses(
        (status = 101, description = "The WebSocket; each text message is an Event"),
        (status = 200, description = "Server-sent events; the data of each is an Event", body = String, content_type = "text/event-stream"),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
        (status = 426, description = "`upgrade_required`: the request asks for neither", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn watch_job(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    Parameters(query): Parameters<EventsQuery>,
    headers: HeaderMap,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Result<Response, Problem> {
    if query.after.is_some_and(|seq| MAX_SEQ < seq) {
        let detail = format!("`after` must be at most {MAX_SEQ}");
        return Err(Problem::new(Code::InvalidRequest, detail));
    }
    // Find the last event that the client has.
    let resumed = headers
        .get("last-event-id")
        .and_then(|id| id.to_str().ok()?.parse().ok());
    let visibility = caller.visibility();
    let Some(events) = app.jobs.subscribe(&visibility, id).await? else {
        return Err(missing(&app, &visibility, id).await);
    };
    let events = events.after(query.after.or(resumed));
    // Send the rest over the protocol that it asks for.
    if let Ok(upgrade) = upgrade {
        let sockets = app.sockets.clone();
        let upgrade = upgrade.max_message_size(MOST_MESSAGE_BYTES);
        return Ok(upgrade
            .on_upgrade(move |socket| sockets.track_future(relay(socket, events, app, caller))));
    }
    let accepted = headers
        .get(header::ACCEPT)
        .and_then(|value| value.to_str().ok());
    if accepted.is_some_and(|types| types.contains("text/event-stream")) {
        return Ok(server_sent(events, app, caller));
    }
    let detail = "connect a WebSocket, or accept text/event-stream";
    Err(Problem::new(Code::UpgradeRequired, detail))
}

fn server_sent(events: Subscription, app: Arc<App>, caller: Caller) -> Response {
    let stream = stream::unfold(events, async |mut events| {
        let event = events.next().await?;
        let sent = sse::Event::default()
            .event("progress")
            .id(event.seq.to_string());
        let sent = sent.data(serde_json::to_string(&event).unwrap_or_default());
        Some((Ok::<_, Infallible>(sent), events))
    });
    // End with the service, or when the key is no longer valid.
    let end = async move {
        tokio::select! {
            () = app.stop.cancelled() => {}
            () = app.keys.lapsed(&caller) => {}
        }
    };
    let stream = stream.take_until(end);
    let events = Sse::new(stream).keep_alive(KeepAlive::new().interval(KEEP_ALIVE));
    // Tell proxies such as nginx not to buffer events.
    ([("x-accel-buffering", "no")], events).into_response()
}

/// Sends events until the last one, the close message of the client, the end of its key, or the stop of the service.
async fn relay(mut socket: WebSocket, mut events: Subscription, app: Arc<App>, caller: Caller) {
    // Send events and pings until something ends the connection; its close code says what.
    let mut lapsed = pin!(app.keys.lapsed(&caller));
    let mut quiet = tokio::time::interval(KEEP_ALIVE);
    let code = loop {
        let message = tokio::select! {
            event = events.next() => match event {
                Some(event) => Message::text(serde_json::to_string(&event).unwrap_or_default()),
                None => break close_code::NORMAL,
            },
            said = socket.recv() => match said {
                Some(Ok(Message::Close(_))) | None => return,
                Some(Ok(_)) => continue,
                Some(Err(error)) => match refusal(error) {
                    Some(code) => break code,
                    None => return,
                },
            },
            _ = quiet.tick() => Message::Ping(Vec::new().into()),
            () = app.stop.cancelled() => break close_code::AWAY,
            () = &mut lapsed => break close_code::POLICY,
        };
        if socket.send(message).await.is_err() {
            return;
        }
    };
    // Close, and wait for the client's answer.
    let close = CloseFrame {
        code,
        reason: "".into(),
    };
    if socket.send(Message::Close(Some(close))).await.is_ok() {
        goodbye(&mut socket).await;
    }
}

// Maps of charts while they relax.

/// Maximum wait for a frame. It stays below the timeouts of common proxies, such as the 60 s of nginx; shorter waits
/// mean more requests while nothing moves.
const PATIENCE: Duration = Duration::from_secs(20);

/// Query for the maps of a job.
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
    State(app): Shared,
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
            JobState::Queued => {}
            state => return state == JobState::Running,
        }
    }
    false
}
