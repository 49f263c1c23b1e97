//! Checksums of stored files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use futures_util::{StreamExt, stream};
use sha2::{Digest, Sha256};

use super::blobs::Content;
use super::store_error::{StoreError, StoreResult};

/// Bytes per read. Larger blocks take more memory per file, smaller ones more system calls.
const BLOCK: usize = 1 << 16;

fn compared(sha256: &str, expected: &str) -> StoreResult<()> {
    if sha256 == expected {
        return Ok(());
    }
    let detail = "a stored file is damaged: its checksum is not that of what was stored";
    Err(StoreError::Damaged(detail.to_owned()))
}

/// Reads a local file and compares its checksum, if one is known.
pub(super) async fn check(path: &Path, expected: Option<&str>) -> StoreResult<()> {
    match expected {
        Some(expected) => compared(&of(path).await?, expected),
        None => Ok(()),
    }
}

/// Returns the SHA-256 of a local file, in hexadecimal digits.
pub(super) async fn of(path: &Path) -> StoreResult<String> {
    let path = path.to_owned();
    let read = tokio::task::spawn_blocking(move || of_file(&path)).await;
    Ok(read.map_err(std::io::Error::from)??)
}

fn of_file(path: &Path) -> std::io::Result<String> {
    let mut file = File::open(path)?;
    let (mut hash, mut block) = (Sha256::new(), vec![0; BLOCK]);
    loop {
        match file.read(&mut block)? {
            0 => return Ok(format!("{:x}", hash.finalize())),
            length => hash.update(&block[..length]),
        }
    }
}

/// Passes a stream through and checks its checksum. On a mismatch it ends with an error in place of the last block,
/// so no reader takes it for complete.
pub(super) fn checked(content: Content, expected: String) -> Content {
    let state = (content, Sha256::new(), None::<Vec<u8>>, Some(expected));
    let blocks = stream::unfold(
        state,
        async |(mut content, mut hash, mut newest, mut end)| {
            loop {
                match content.next().await {
                    // Hold back the newest block, since the last one is passed on only if the checksum matches.
                    Some(Ok(block)) => {
                        hash.update(&block);
                        if let Some(block) = newest.replace(block) {
                            return Some((Ok(block), (content, hash, newest, end)));
                        }
                    }
                    Some(Err(error)) => return Some((Err(error), (content, hash, None, None))),
                    None => {
                        let expected = end.take()?;
                        let sha256 = format!("{:x}", std::mem::take(&mut hash).finalize());
                        let last = compared(&sha256, &expected);
                        let last = last.map(|()| newest.take().unwrap_or_default());
                        return Some((last, (content, hash, None, None)));
                    }
                }
            }
        },
    );
    blocks.boxed()
}
