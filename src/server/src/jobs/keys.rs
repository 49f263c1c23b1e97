//! The names under which blobs of a job are stored.

use super::job::JobId;
use super::lease::Token;
use unwrapd_api::OutputFile;

pub(super) fn input_key(id: JobId, index: usize) -> String {
    format!("{id}/input/{index}")
}

/// The folder of what one attempt made: an outdated one never touches the files of its successor.
/// No attempt has the token 0; files of versions without tokens lie there.
pub(super) fn output_folder(id: JobId, token: Token) -> String {
    match token {
        0 => format!("{id}/output"),
        _ => format!("{id}/output-{token}"),
    }
}

pub(super) fn output_key(id: JobId, token: Token, index: usize) -> String {
    format!("{}/{index}", output_folder(id, token))
}

/// Where a picture lies that was drawn after the job ended. The name says what is in it: who draws the same again stores the same,
/// and who draws another one does not overwrite it.
pub(super) fn picture_key(id: JobId, token: Token, file: &OutputFile) -> String {
    let sha256 = file.sha256.as_deref().unwrap_or_default();
    format!("{}/{sha256}-{}", output_folder(id, token), file.role)
}
