//! Common parts of all WebSockets.

use std::future::pending;
use std::time::Duration;

use axum::extract::ws::{Message, close_code};
use futures_util::{Stream, StreamExt};
use tungstenite::Error;

/// Interval of pings on a quiet connection. Proxies close quiet connections, nginx after 60 s by default.
pub(super) const KEEP_ALIVE: Duration = Duration::from_secs(15);
/// Maximum size of a message in bytes, far above that of a handle or of settings. Each message is held in memory.
pub(super) const MOST_MESSAGE_BYTES: usize = 64 << 10;
/// Time for a client to answer a close frame. A client that does not answer keeps its connection this long.
const CLOSE_TIME: Duration = Duration::from_secs(1);

/// Returns the close code for a message that could not be read; `None` if the client is gone.
pub(super) fn refusal(error: axum::Error) -> Option<u16> {
    match error.into_inner().downcast_ref()? {
        Error::Capacity(_) => Some(close_code::SIZE),
        Error::Utf8(_) => Some(close_code::INVALID),
        Error::Protocol(_) => Some(close_code::PROTOCOL),
        _ => None,
    }
}

/// Waits a moment for the answer to a close frame. Closing a connection with unread data would reset it, and the
/// client would not see the frame.
pub(super) async fn goodbye<E>(socket: &mut (impl Stream<Item = Result<Message, E>> + Unpin)) {
    let answer = async {
        while let Some(said) = socket.next().await {
            if said.is_err() {
                pending::<()>().await;
            }
        }
    };
    let _ = tokio::time::timeout(CLOSE_TIME, answer).await;
}
