//! Asynchronous records on the pipe between server and child.

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio_util::bytes::Bytes;

use unwrapd_api::pipe::{head, length};

/// Writes a record.
pub(super) async fn send(
    to: &mut (impl AsyncWrite + Unpin),
    tag: u8,
    bytes: &[u8],
) -> std::io::Result<()> {
    to.write_all(&[&head(tag, bytes.len()), bytes].concat())
        .await
}

/// Reads a record: its tag and its bytes.
pub(super) async fn receive(from: &mut (impl AsyncRead + Unpin)) -> std::io::Result<(u8, Bytes)> {
    let mut head = [0; 5];
    from.read_exact(&mut head).await?;
    let mut bytes = vec![0; length(head)?];
    from.read_exact(&mut bytes).await?;
    Ok((head[0], bytes.into()))
}
