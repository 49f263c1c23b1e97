//! The GLB container: a header, a JSON chunk, a binary chunk, unknown chunks.
use super::json::invalid;
use crate::document::DocumentError;

const MAGIC: &[u8; 4] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// The parts of a GLB file.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    pub bin: Option<&'a [u8]>,
    /// Chunks of other types, which the format tells readers to ignore; they are written back.
    pub others: Vec<(u32, &'a [u8])>,
}

/// Returns whether the bytes claim to be GLB.
pub(super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Splits a GLB file. Bytes beyond the length in its header are ignored.
pub(super) fn split(bytes: &[u8]) -> Result<Container<'_>, DocumentError> {
    let truncated = || invalid("the GLB file is truncated");
    let version = word(bytes, 4).ok_or_else(truncated)?;
    if version != 2 {
        return Err(DocumentError::UnsupportedVersion(version.to_string()));
    }
    let length = word(bytes, 8).ok_or_else(truncated)? as usize;
    let mut rest = bytes.get(12..length).ok_or_else(truncated)?;
    let mut chunks = Vec::new();
    while !rest.is_empty() {
        let length = word(rest, 0).ok_or_else(truncated)? as usize;
        let kind = word(rest, 4).ok_or_else(truncated)?;
        let end = length.checked_add(8).ok_or_else(truncated)?;
        chunks.push((kind, rest.get(8..end).ok_or_else(truncated)?));
        rest = &rest[end..];
    }
    let mut chunks = chunks.into_iter().peekable();
    let Some((JSON, json)) = chunks.next() else {
        return Err(invalid("the first GLB chunk is not JSON"));
    };
    let bin = chunks.next_if(|chunk| chunk.0 == BIN).map(|chunk| chunk.1);
    let others = chunks.filter(|chunk| chunk.0 != JSON && chunk.0 != BIN);
    Ok(Container {
        json,
        bin,
        others: others.collect(),
    })
}

/// Joins the parts of a GLB file. An empty binary chunk is left out.
pub(super) fn join(
    json: &[u8],
    bin: &[u8],
    others: &[(u32, Vec<u8>)],
) -> Result<Vec<u8>, DocumentError> {
    let mut bytes = Vec::with_capacity(28 + json.len() + bin.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&2u32.to_le_bytes());
    bytes.extend_from_slice(&[0; 4]);
    push_chunk(&mut bytes, JSON, json, b' ')?;
    if !bin.is_empty() {
        push_chunk(&mut bytes, BIN, bin, 0)?;
    }
    for (kind, content) in others {
        push_chunk(&mut bytes, *kind, content, 0)?;
    }
    let length = length_word(bytes.len())?;
    bytes[8..12].copy_from_slice(&length);
    Ok(bytes)
}

fn push_chunk(
    bytes: &mut Vec<u8>,
    kind: u32,
    content: &[u8],
    padding: u8,
) -> Result<(), DocumentError> {
    let padded = content.len().next_multiple_of(4);
    bytes.extend_from_slice(&length_word(padded)?);
    bytes.extend_from_slice(&kind.to_le_bytes());
    bytes.extend_from_slice(content);
    bytes.resize(bytes.len() + padded - content.len(), padding);
    Ok(())
}

fn length_word(length: usize) -> Result<[u8; 4], DocumentError> {
    u32::try_from(length)
        .map(u32::to_le_bytes)
        .map_err(|_| DocumentError::LimitExceeded("a GLB file holds at most 4 GiB".to_owned()))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(word.try_into().ok()?))
}
