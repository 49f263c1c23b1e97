//! The mark of an OBJ file: a comment in its first line.
use super::mark::Mark;
use super::{DocumentError, Terms, Written};
use serde_json::Value;

/// Beginning of the line.
const BEGIN: &[u8] = b"# unwrapd {";

/// Returns the value in the place of a mark.
pub(super) fn find(text: &[u8]) -> Option<Value> {
    let line = &text[..length(text)];
    serde_json::from_slice(line.get(BEGIN.len() - 1..)?).ok()
}

/// Replaces the mark of the main file by one with the purpose of its UVs, if that is known. The marked UVs are those
/// that are read from the file, because its polygons determine the triangles.
pub(super) fn renew(written: &mut Written, terms: Option<&Terms>) -> Result<(), DocumentError> {
    let again = written.read_again()?;
    let Some((_, text)) = written.files.first_mut() else {
        return Ok(());
    };
    text.drain(..length(text));
    if let (Some(terms), Some(uvs)) = (terms, again.corner_uvs(0, 0)?) {
        let mark = Mark::new(terms, std::iter::once(Some((0, uvs))));
        let line = format!("# unwrapd {}\n", mark.value());
        text.splice(..0, line.into_bytes());
    }
    Ok(())
}

/// Returns the length in bytes of the line with the mark; 0 if there is none.
fn length(text: &[u8]) -> usize {
    if !text.starts_with(BEGIN) {
        return 0;
    }
    let end = text.iter().position(|&byte| byte == b'\n');
    end.map_or(text.len(), |end| end + 1)
}
