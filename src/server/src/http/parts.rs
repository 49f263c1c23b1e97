//! Form parts: their texts and their errors.

use axum::extract::multipart::{Field, MultipartError};

use super::handling::HandlingBuilder;
use super::problem::{Code, Problem};

/// Names of the part that holds the input.
pub(super) const INPUT_PARTS: [&str; 3] = ["mesh", "image", "problem"];
/// Maximum number of files of an upload. Each is a file on disk and an entry of the record.
pub(super) const MAX_FILES: usize = 4096;
/// Maximum length of a resource path in bytes. With `MAX_FILES`, it bounds the names in a record to 4 MiB.
const MAX_NAME: usize = 1024;
/// Maximum length of a text part in bytes: enough for options with some thousand handles.
const MAX_TEXT_BYTES: u64 = 256 << 10;

/// Reads the text of a part.
pub(super) async fn text(mut field: Field<'_>) -> Result<String, Problem> {
    let mut bytes = Vec::new();
    while let Some(chunk) = field.chunk().await.map_err(|e| malformed(&e))? {
        bytes.extend_from_slice(&chunk);
        if MAX_TEXT_BYTES < bytes.len() as u64 {
            let detail = format!("a text part can have at most {MAX_TEXT_BYTES} bytes");
            return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_TEXT_BYTES));
        }
    }
    String::from_utf8(bytes)
        .map_err(|_| Problem::new(Code::InvalidRequest, "a text part is not UTF-8"))
}

/// Rejects file paths that are too long.
pub(super) fn at_most_name(name: &str) -> Result<(), Problem> {
    at_most(name, MAX_NAME)
}

/// Rejects file names of more than `bytes` bytes.
pub(super) fn at_most(name: &str, bytes: usize) -> Result<(), Problem> {
    if name.len() <= bytes {
        return Ok(());
    }
    let detail = format!("a file name can have at most {bytes} bytes");
    Err(Problem::new(Code::InvalidRequest, detail))
}

/// Returns the problem of an unknown part.
pub(super) fn unexpected(part: &str) -> Problem {
    let part: String = part.chars().take(100).collect();
    let detail = format!(
        "unexpected part {part:?}: the parts of a form are mesh, image or problem, resource, options, kind, {}",
        HandlingBuilder::NAMES.join(", ")
    );
    Problem::new(Code::InvalidRequest, detail)
}

/// Returns the problem of a malformed form.
pub(super) fn malformed(error: &MultipartError) -> Problem {
    Problem::new(Code::InvalidRequest, error.body_text())
}
