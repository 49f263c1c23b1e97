//! The mark of an OBJ file: a comment in its first line.
use super::mark::Mark;
use super::{DocumentError, Terms, Written};
use serde_json::Value;

/// What the line begins with.
const BEGIN: &[u8] = b"# unwrapd {";

/// What the text has in the place of a mark.
pub(super) fn find(text: &[u8]) -> Option<Value> {
    let line = &text[..length(text)];
    serde_json::from_slice(line.get(BEGIN.len() - 1..)?).ok()
}

/// Lets the main file say what its UVs were made for, if that is known, and no longer what an older line says. The UVs are those
/// that are read of it: its polygons tell the triangles.
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

/// The bytes of the line with the mark; 0 where there is none.
fn length(text: &[u8]) -> usize {
    if !text.starts_with(BEGIN) {
        return 0;
    }
    let end = text.iter().position(|&byte| byte == b'\n');
    end.map_or(text.len(), |end| end + 1)
}
