//! Live sessions: the routes to open, list, get, close and bake them, and their WebSocket.

use std::sync::Arc;

use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, WebSocketUpgrade, close_code};
use axum::extract::{FromRequestParts, Path, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use serde::Serialize;
use serde_json::Value;
use tokio::sync::broadcast::error::RecvError;

use super::app::{App, Shared, json};
use super::input::{self, Defaults, JobFile};
use super::jobs::located;
use super::problem::{Code, Problem};
use super::socket::{KEEP_ALIVE, MOST_MESSAGE_BYTES, goodbye, refusal};
use super::upload::accepts;
use super::view::JobView;
use crate::jobs::access::Caller;
use crate::jobs::{JobId, Submitted};
use crate::sessions::{Baked, NewSession, OpenSession, SessionEnd, Unopened};
use unwrapd_api::{Failure, Kind};

/// A live session.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Session)]
struct SessionView {
    /// Identifies the session.
    #[schema(format = "uuid")]
    id: String,
    /// Kind of job that the session can be baked to.
    kind: Kind,
    /// Name of the mesh, picture or drawing.
    filename: String,
    /// All options of the job, with defaults filled in.
    #[schema(value_type = Object)]
    options: Value,
    /// Number of connected clients.
    clients: usize,
    /// Seconds since a client sent a message.
    idle_seconds: f64,
    /// Seconds without a message after which the session ends.
    idle_limit_seconds: f64,
    /// Paths of related resources.
    links: SessionLinks,
}

/// Paths of the resources of a session.
#[derive(Serialize, utoipa::ToSchema)]
struct SessionLinks {
    /// The session.
    #[serde(rename = "self")]
    itself: String,
    /// The WebSocket of its messages and frames.
    live: String,
    /// Path for baking the session to a job.
    bake: String,
}

/// The sessions of a process.
#[derive(Serialize, utoipa::ToSchema)]
struct SessionList {
    /// The sessions, oldest first.
    sessions: Vec<SessionView>,
    /// Maximum number of sessions.
    limit: usize,
}

fn path(app: &App, id: JobId) -> String {
    format!("{}/v1/sessions/{id}", app.settings.base_path)
}

fn view(app: &App, session: &OpenSession) -> SessionView {
    let path = path(app, session.id);
    SessionView {
        id: session.id.to_string(),
        kind: session.kind,
        filename: session
            .input
            .first()
            .map_or_else(String::new, |file| file.name.clone()),
        options: session.options.clone(),
        clients: session.n_clients(),
        idle_seconds: session.idle().as_secs_f64(),
        idle_limit_seconds: app.sessions.settings().idle.as_secs_f64(),
        links: SessionLinks {
            live: format!("{path}/live"),
            bake: format!("{path}/bake"),
            itself: path,
        },
    }
}

/// A session edits the UVs that the job of its query made, unless the query says otherwise.
const DEFAULTS: Defaults = Defaults {
    kind: Kind::EditUv,
    file: JobFile::Result,
};

/// Extractor of the session in the path, if it is visible to the caller.
pub(super) struct PathSession(pub Arc<OpenSession>);

impl FromRequestParts<Arc<App>> for PathSession {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, app: &Arc<App>) -> Result<Self, Problem> {
        let caller = Caller::from_request_parts(parts, app).await?;
        let id = Path::<String>::from_request_parts(parts, app).await;
        let id: Option<JobId> = id.ok().and_then(|Path(id)| id.parse().ok());
        id.and_then(|id| app.sessions.get(&caller.visibility(), id))
            .map(Self)
            .ok_or_else(|| Problem::new(Code::SessionNotFound, "it never existed, or it has ended"))
    }
}

/// Open a live session.
///
/// In a session, handles pull a mesh, a picture or UVs while a client watches, or hold UV islands while
/// others make room. The input and the options are those of a job of kind `deform`, `warp`, `edit_uv`,
/// `texture_map` or `repack`. Instead of an upload, the query parameter `job` takes the input or the result of an ended job; `file` says which.
/// A session has a process of its own. It ends after some minutes without a message, or when the
/// service stops.
///
/// The answer is sent when the input has been read. The WebSocket under `links.live` then takes
/// messages and sends frames: see `live.md` beside this document.
#[utoipa::path(
    post, path = "/v1/sessions", operation_id = "openSession", tag = "sessions",
    params(
        ("kind" = Option<Kind>, Query, description = "`deform`, `warp`, `edit_uv`, `texture_map` or `repack`. With `job` the default is `edit_uv`; an upload has to say it, here or in the form"),
        ("filename" = Option<String>, Query, description = "File name of a raw body"),
        ("job" = Option<String>, Query, format = "uuid", description = "The ended job to take the input from; there is no body then"),
        ("file" = Option<JobFile>, Query, description = "With `job`: the file to take; the default is `result`"),
    ),
    responses(
        (status = 201, description = "The session", body = SessionView, headers(("Location" = String, description = "Path of the session"))),
        (status = 400, description = "`invalid_request`, `invalid_options`, `missing_mesh`", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`, `no_result`", body = Problem, content_type = "application/problem+json"),
        (status = 410, description = "`job_expired`", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "`upload_too_large`", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "`unsupported_media_type`", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The input cannot be used; the code names the cause", body = Problem, content_type = "application/problem+json"),
        (status = 503, description = "`sessions_taken`: try again later; `draining`: try again elsewhere", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "`storage_full`: delete jobs, or try again later", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn open_session(
    State(app): Shared,
    caller: Caller,
    request: Request,
) -> Result<Response, Problem> {
    let received = input::receive(&app, &caller, request, DEFAULTS).await?;
    let opened = NewSession {
        owner: caller.owner().clone(),
        kind: received.kind,
        options: received.options,
        files: received.files,
    };
    let session = app.sessions.open(opened).await?;
    let mut response = json(StatusCode::CREATED, &view(&app, &session));
    if let Ok(path) = HeaderValue::from_str(&path(&app, session.id)) {
        response.headers_mut().insert(header::LOCATION, path);
    }
    Ok(response)
}

impl From<Unopened> for Problem {
    fn from(error: Unopened) -> Self {
        match error {
            Unopened::AllTaken => Self::new(Code::SessionsTaken, "try again later"),
            Unopened::OwnTaken => {
                Self::new(Code::SessionsTaken, "end one of yours, or try again later")
            }
            Unopened::Failed(failure) => Self::of_failure(&failure),
        }
    }
}

/// List the live sessions of this process.
#[utoipa::path(
    get, path = "/v1/sessions", operation_id = "listSessions", tag = "sessions",
    responses((status = 200, description = "The sessions", body = SessionList))
)]
pub(super) async fn list_sessions(State(app): Shared, caller: Caller) -> Response {
    let sessions = app.sessions.list(&caller.visibility());
    let list = SessionList {
        sessions: sessions.iter().map(|session| view(&app, session)).collect(),
        limit: app.sessions.settings().most,
    };
    json(StatusCode::OK, &list)
}

/// Get a live session.
#[utoipa::path(
    get, path = "/v1/sessions/{id}", operation_id = "getSession", tag = "sessions",
    params(("id" = String, Path, format = "uuid", description = "The session")),
    responses(
        (status = 200, description = "The session", body = SessionView),
        (status = 404, description = "`session_not_found`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_session(State(app): Shared, PathSession(session): PathSession) -> Response {
    json(StatusCode::OK, &view(&app, &session))
}

/// End a live session.
///
/// Its process ends, and what was not baked is lost.
#[utoipa::path(
    delete, path = "/v1/sessions/{id}", operation_id = "closeSession", tag = "sessions",
    params(("id" = String, Path, format = "uuid", description = "The session")),
    responses(
        (status = 204, description = "The session is ending"),
        (status = 404, description = "`session_not_found`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn close_session(PathSession(session): PathSession) -> Response {
    session.close(SessionEnd::Closed);
    StatusCode::NO_CONTENT.into_response()
}

/// Bake a live session.
///
/// Creates a job with the input and the options of the session, its present handles, and its present
/// map as the start. A job of kind `repack` has a handle for every island instead of a start. The job finishes what is under way, and writes, judges and reports the result like any
/// other. The session goes on.
#[utoipa::path(
    post, path = "/v1/sessions/{id}/bake", operation_id = "bakeSession", tag = "sessions",
    params(("id" = String, Path, format = "uuid", description = "The session")),
    responses(
        (status = 202, description = "The accepted job", body = JobView, headers(("Location" = String, description = "Path of the job"))),
        (status = 404, description = "`session_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "`no_handle`", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "`owner_quota_used`: jobs, bytes or processor time of the owner", body = Problem, content_type = "application/problem+json"),
        (status = 503, description = "`queue_full`, `store_unavailable`: try again later; `draining`: try again elsewhere", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "`storage_full`: delete jobs, or try again later", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn bake_session(
    State(app): Shared,
    PathSession(session): PathSession,
) -> Result<Response, Problem> {
    accepts(&app)?;
    let baked = session.bake().await;
    let Baked {
        submission,
        folder: _folder,
    } = baked.map_err(|failure: Failure| Problem::of_failure(&failure))?;
    let job = match app.jobs.submit(submission).await? {
        Submitted::New(job) | Submitted::Replay(job) => job,
    };
    Ok(located(&app, StatusCode::ACCEPTED, &job))
}

// The WebSocket of a session.

/// Pull what a session holds, live.
///
/// A WebSocket. The client sends messages as JSON texts. The server sends the mesh once, then
/// frames, both binary, and a reply to each message. Frames that a slow client has not received are
/// dropped in favor of the latest. The close code is 1000 if the session was ended or expired, 1001
/// if the service stops, 1008 if the key is refused from now on, and 1009 after a message of more
/// than 64 KiB. It is 1011 if the computation failed, with the code of the failure as the reason.
/// `live.md` beside this document describes messages, replies, meshes and frames.
#[utoipa::path(
    get, path = "/v1/sessions/{id}/live", operation_id = "pullSession", tag = "sessions",
    params(("id" = String, Path, format = "uuid", description = "The session")),
    responses(
        (status = 101, description = "The connection is a WebSocket"),
        (status = 404, description = "`session_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 426, description = "`upgrade_required`: the request does not ask for a WebSocket", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn pull_session(
    State(app): Shared,
    caller: Caller,
    PathSession(session): PathSession,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Result<Response, Problem> {
    let Ok(upgrade) = upgrade else {
        return Err(Problem::new(Code::UpgradeRequired, "connect a WebSocket"));
    };
    let sockets = app.sockets.clone();
    let upgrade = upgrade.max_message_size(MOST_MESSAGE_BYTES);
    Ok(upgrade.on_upgrade(move |socket| sockets.track_future(relay(socket, session, app, caller))))
}

/// Relays until the session, the connection or the client's key ends.
async fn relay(socket: WebSocket, session: Arc<OpenSession>, app: Arc<App>, caller: Caller) {
    let (mut sink, mut stream) = socket.split();
    let code = tokio::select! {
        code = hear(&mut stream, &session) => code.map(|code| (code, String::new())),
        code = tell(&mut sink, &session) => code,
        () = app.keys.lapsed(&caller) => Some((close_code::POLICY, "key_refused".to_owned())),
    };
    let Some((code, reason)) = code else {
        return;
    };
    let reason = Utf8Bytes::from(reason);
    let close = Message::Close(Some(CloseFrame { code, reason }));
    if sink.send(close).await.is_ok() {
        goodbye(&mut stream).await;
    }
}

/// Passes messages to the session until one cannot be read. Returns the close code; `None` if the client is gone.
async fn hear(stream: &mut SplitStream<WebSocket>, session: &OpenSession) -> Option<u16> {
    loop {
        let said = match stream.next().await? {
            Err(error) => return refusal(error),
            Ok(Message::Text(text)) => session.say(text.as_bytes()).await,
            Ok(Message::Close(_)) => return None,
            Ok(Message::Binary(_) | Message::Ping(_) | Message::Pong(_)) => Ok(()),
        };
        if said.is_err() {
            // The child is gone: wait for the reason, which `tell` sends.
            session.ended().await;
        }
    }
}

/// Sends the mesh, frames and replies until the session ends. Returns the close code and reason; `None` if the client
/// is gone.
async fn tell(
    sink: &mut SplitSink<WebSocket, Message>,
    session: &OpenSession,
) -> Option<(u16, String)> {
    // Subscribe before sending the mesh, so that no reply is missed.
    let (mut frames, mut replies) = (session.frames(), session.replies());
    sink.send(Message::Binary(session.mesh.clone()))
        .await
        .ok()?;
    let mut quiet = tokio::time::interval(KEEP_ALIVE);
    // Send the present frame first, even if it does not change any more.
    frames.mark_changed();
    loop {
        // The end comes before replies, and replies before frames, which may be skipped.
        let message = tokio::select! {
            biased;
            why = session.ended() => return Some(closing(why)),
            reply = replies.recv() => match reply {
                Ok(reply) => Message::Text(Utf8Bytes::try_from(reply).ok()?),
                Err(RecvError::Lagged(_)) => {
                    return Some((close_code::POLICY, "too_slow".to_owned()));
                }
                Err(RecvError::Closed) => return None,
            },
            changed = frames.changed() => {
                changed.ok()?;
                let frame = frames.borrow_and_update().clone();
                if frame.is_empty() {
                    continue;
                }
                Message::Binary(frame)
            }
            _ = quiet.tick() => Message::Ping(Vec::new().into()),
        };
        sink.send(message).await.ok()?;
    }
}

fn closing(why: SessionEnd) -> (u16, String) {
    match why {
        SessionEnd::Closed => (close_code::NORMAL, "closed".to_owned()),
        SessionEnd::Expired => (close_code::NORMAL, "expired".to_owned()),
        SessionEnd::Stopping => (close_code::AWAY, "stopping".to_owned()),
        SessionEnd::Failed(failure) => (close_code::ERROR, failure.code),
    }
}
