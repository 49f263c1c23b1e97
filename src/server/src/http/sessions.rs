//! Routes of live sessions: open, list, get, close, bake.

use std::sync::Arc;

use axum::extract::{FromRequestParts, Path, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde_json::Value;

use super::app::{App, Shared, json};
use super::create::located;
use super::problem::{Code, Problem};
use super::session_input::received;
use super::view::JobView;
use crate::jobs::access::Caller;
use crate::jobs::{JobId, Submitted};
use crate::sessions::{Baked, End, Opened, Session, Unopened};
use unwrapd_api::{Failure, Kind};

/// A live session.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Session)]
pub(super) struct SessionView {
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
    /// Where it is baked.
    bake: String,
}

/// The sessions of a process.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct SessionList {
    /// The sessions, oldest first.
    sessions: Vec<SessionView>,
    /// Maximum number of sessions.
    limit: usize,
}

fn path(app: &App, id: JobId) -> String {
    format!("{}/v1/sessions/{id}", app.settings.base_path)
}

fn view(app: &App, session: &Session) -> SessionView {
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

/// Extractor of the session in the path, if it is visible to the caller.
pub(super) struct PathSession(pub Arc<Session>);

impl FromRequestParts<Arc<App>> for PathSession {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, app: &Arc<App>) -> Result<Self, Problem> {
        let missing = || Problem::new(Code::SessionNotFound, "it never existed, or it has ended");
        let caller = Caller::from_request_parts(parts, app).await?;
        let id = Path::<String>::from_request_parts(parts, app).await;
        let id: Option<JobId> = id.ok().and_then(|Path(id)| id.parse().ok());
        id.and_then(|id| app.sessions.get(&caller.visibility(), id))
            .map(Self)
            .ok_or_else(missing)
    }
}

/// Open a live session.
///
/// In a session, handles pull a mesh, a picture or UVs while a client watches. The input and the
/// options are those of a job of kind `deform`, `warp`, `edit_uv` or `texture_map`. Instead of an
/// upload, the query parameter `job` takes the input or the result of an ended job; `file` says which.
/// A session has a process of its own. It ends after some minutes without a message, or when the
/// service stops.
///
/// The answer is sent when the input has been read. The WebSocket under `links.live` then takes
/// messages and sends frames: see `live.md` beside this document.
#[utoipa::path(
    post, path = "/v1/sessions", operation_id = "openSession", tag = "sessions",
    params(
        ("kind" = Option<Kind>, Query, description = "`deform`, `warp`, `edit_uv` or `texture_map`. With `job` the default is `edit_uv`; an upload has to say it, here or in the form"),
        ("filename" = Option<String>, Query, description = "File name of a raw body"),
        ("job" = Option<String>, Query, format = "uuid", description = "The ended job to take the input from; there is no body then"),
        ("file" = Option<super::session_input::JobFile>, Query, description = "With `job`: the file to take; the default is `result`"),
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
    let received = received(&app, &caller, request).await?;
    let opened = Opened {
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
    session.close(End::Closed);
    StatusCode::NO_CONTENT.into_response()
}

/// Bake a live session.
///
/// Creates a job with the input and the options of the session, its present handles, and its present
/// map as the start. The job finishes what is under way, and writes, judges and reports the result like any
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
    super::upload::accepts(&app)?;
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
