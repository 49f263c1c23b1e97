//! Records of the pipe between server and child, written and read without blocking.

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio_util::bytes::Bytes;

use unwrapd_api::pipe::{head, length};

/// Writes a record without blocking.
pub(super) async fn send(
    to: &mut (impl AsyncWrite + Unpin),
    tag: u8,
    bytes: &[u8],
) -> std::io::Result<()> {
    to.write_all(&[&head(tag, bytes.len()), bytes].concat())
        .await
}

/// Reads a record without blocking.
pub(super) async fn receive(from: &mut (impl AsyncRead + Unpin)) -> std::io::Result<(u8, Bytes)> {
    let mut head = [0; 5];
    from.read_exact(&mut head).await?;
    let mut bytes = vec![0; length(head)?];
    from.read_exact(&mut bytes).await?;
    Ok((head[0], bytes.into()))
}
