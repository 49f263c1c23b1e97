//! Files of jobs: their keys and checksums, and the temporary folders in which they are made.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use futures_util::{StreamExt, stream};
use nix::sys::statvfs::statvfs;
use sha2::{Digest, Sha256};

use super::job::{JobId, Token};
use super::storage::Content;
use super::store_error::{StoreError, StoreResult};
use unwrapd_api::OutputFile;

pub(super) fn input_key(id: JobId, index: usize) -> String {
    format!("{id}/input/{index}")
}

/// Returns the folder for the output of one attempt: an outdated attempt never touches the files of its successor. The
/// token 0, which no attempt has, stands for the files of versions without tokens.
pub(super) fn output_folder(id: JobId, token: Token) -> String {
    match token {
        0 => format!("{id}/output"),
        _ => format!("{id}/output-{token}"),
    }
}

pub(super) fn output_key(id: JobId, token: Token, index: usize) -> String {
    format!("{}/{index}", output_folder(id, token))
}

/// Returns the key of a picture that was drawn after the job ended. The key contains the checksum: drawing the same
/// picture again stores the same file, and a different picture never overwrites it.
pub(super) fn picture_key(id: JobId, token: Token, file: &OutputFile) -> String {
    let sha256 = file.sha256.as_deref().unwrap_or_default();
    format!("{}/{sha256}-{}", output_folder(id, token), file.role)
}

// Checksums of stored files.

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
pub(super) async fn check_sha256(path: &Path, expected: Option<&str>) -> StoreResult<()> {
    match expected {
        Some(expected) => compared(&sha256_of(path).await?, expected),
        None => Ok(()),
    }
}

/// Returns the SHA-256 of a local file, in hexadecimal digits.
pub(super) async fn sha256_of(path: &Path) -> StoreResult<String> {
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

// Temporary folders.

/// A folder that is removed with its contents on drop.
#[derive(Debug)]
pub struct Scratch(PathBuf);

impl Scratch {
    /// Creates the folder.
    pub fn make(path: PathBuf) -> std::io::Result<Self> {
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }

    /// Returns its path.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        if let Err(error) = std::fs::remove_dir_all(&self.0) {
            tracing::warn!(%error, "folder not removed");
        }
    }
}

// Free space of file systems.

/// Returns the number of bytes free for writing on the file system of a path.
pub fn free_bytes(path: &Path) -> StoreResult<u64> {
    let system = statvfs(path).map_err(std::io::Error::from)?;
    Ok(system.blocks_available() * system.fragment_size())
}
