//! Blob keys of a job's files.

use super::job::JobId;
use super::lease::Token;
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
