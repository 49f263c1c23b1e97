//! What all WebSockets have in common.

use std::time::Duration;

use axum::extract::ws::Message;
use futures_util::{Stream, StreamExt};

/// Between signs of life on a quiet connection.
pub(super) const KEEP_ALIVE: Duration = Duration::from_secs(15);
/// For a client to answer a close frame.
const CLOSE_TIME: Duration = Duration::from_secs(1);

/// Waits a moment for the answer to a close frame.
pub(super) async fn goodbye<E>(socket: &mut (impl Stream<Item = Result<Message, E>> + Unpin)) {
    let answer = async { while let Some(Ok(_)) = socket.next().await {} };
    let _ = tokio::time::timeout(CLOSE_TIME, answer).await;
}
