//! The WebSocket of a session.

use std::sync::Arc;

use axum::extract::State;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, WebSocketUpgrade, close_code};
use axum::response::Response;
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use tokio::sync::broadcast::error::RecvError;

use super::app::{App, Shared};
use super::problem::{Code, Problem};
use super::sessions::PathSession;
use super::socket::{KEEP_ALIVE, MOST_MESSAGE_BYTES, goodbye, refusal};
use crate::jobs::access::Caller;
use crate::sessions::{End, Session};

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
    let relayed = move |socket| sockets.track_future(relay(socket, session, app, caller));
    Ok(upgrade.on_upgrade(relayed))
}

/// Relays until the session, the connection or the client's key ends.
async fn relay(socket: WebSocket, session: Arc<Session>, app: Arc<App>, caller: Caller) {
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
async fn hear(stream: &mut SplitStream<WebSocket>, session: &Session) -> Option<u16> {
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
    session: &Session,
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

fn closing(why: End) -> (u16, String) {
    match why {
        End::Closed => (close_code::NORMAL, "closed".to_owned()),
        End::Expired => (close_code::NORMAL, "expired".to_owned()),
        End::Stopping => (close_code::AWAY, "stopping".to_owned()),
        End::Failed(failure) => (close_code::ERROR, failure.code),
    }
}
