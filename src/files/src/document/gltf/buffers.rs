//! Buffers: found, checked, decompressed and joined into one, so that all other code sees a single array of bytes.

use super::body::GltfBody;
use super::compression;
use super::json::{
    array_mut, invalid, items, object_mut, parse, remove, remove_extension, required, unsigned,
};
use crate::document::gltf::compression::most_decoded;
use crate::document::{DocumentError, Upload, uri};
use crate::io::without_mark;
use serde_json::{Value, json};
use std::borrow::Cow;

/// Most zeros that stand for buffers without content, which glTF allows.
const MAX_UNDEFINED: usize = 1 << 20;

/// Bytes of a buffer; `None` if the document leaves them undefined.
type Buffer<'a> = Option<Cow<'a, [u8]>>;

/// Joins all buffers of the document into `buffers[0]`. The first keeps its place; views move with their bytes; views
/// compressed with meshopt get their decoded bytes; fallback buffers that nothing else needs are dropped.
pub(super) fn join(
    mut json: Value,
    bin: Option<&[u8]>,
    upload: &Upload,
) -> Result<GltfBody, DocumentError> {
    let buffers = load(&json, bin, upload)?;
    // Buffers that views other than compressed ones need.
    let views = items(&json, "bufferViews")?;
    let mut needed: Vec<bool> = items(&json, "buffers")?
        .iter()
        .map(|buffer| !compression::is_fallback(buffer))
        .collect();
    for view in views
        .iter()
        .filter(|view| compression::of_view(view).is_none())
    {
        let buffer = required(view, "buffer")?;
        *needed
            .get_mut(buffer)
            .ok_or_else(|| invalid(format!("buffers[{buffer}] does not exist")))? = true;
    }
    let mut body = GltfBody {
        json: Value::Null,
        bin: Vec::new(),
    };
    // Append the needed buffers whole, so that the offsets within them stay.
    let mut bases = Vec::with_capacity(buffers.len());
    for (buffer, needed) in buffers.iter().zip(&needed) {
        let bytes = buffer.as_deref().filter(|_| *needed);
        bases.push(bytes.map(|bytes| body.push_bytes(bytes)));
    }
    reserve(&mut body, &json, &buffers)?;
    // Move or decode every view.
    for (index, view) in array_or_empty(&mut json, "bufferViews")?
        .iter_mut()
        .enumerate()
    {
        let moved = if compression::of_view(view).is_some() {
            decode(view, &buffers, &mut body)
        } else {
            relocate(view, &buffers, &bases)
        };
        moved.map_err(|error| match error {
            DocumentError::InvalidGltf(message) => {
                invalid(format!("bufferViews[{index}]: {message}"))
            }
            error => error,
        })?;
    }
    // Leave one buffer, without URI and compression.
    if json.get("buffers").is_some() {
        array_mut(&mut json, "buffers")?.truncate(1);
    }
    for buffer in array_or_empty(&mut json, "buffers")? {
        remove(buffer, "uri");
        for name in compression::MESHOPT {
            remove_extension(buffer, name);
        }
    }
    body.json = json;
    Ok(body)
}

/// Returns a top-level array, empty if it is missing, without creating it.
fn array_or_empty<'a>(json: &'a mut Value, key: &str) -> Result<&'a mut [Value], DocumentError> {
    if json.get(key).is_some() {
        array_mut(json, key).map(Vec::as_mut_slice)
    } else {
        Ok(&mut [])
    }
}

fn load<'a>(
    json: &Value,
    bin: Option<&'a [u8]>,
    upload: &'a Upload,
) -> Result<Vec<Buffer<'a>>, DocumentError> {
    let mut buffers = Vec::new();
    let mut undefined = MAX_UNDEFINED;
    for (index, buffer) in items(json, "buffers")?.iter().enumerate() {
        let length = required(buffer, "byteLength")?;
        // Take the bytes from the URI or the GLB; undefined ones are zeros, within a limit.
        let bytes = match buffer.get("uri") {
            Some(Value::String(uri)) => match uri::resolve(uri, &upload.resources) {
                Err(DocumentError::MissingResource(_)) if compression::is_fallback(buffer) => None,
                resolved => Some(resolved?),
            },
            Some(_) => return Err(invalid("a buffer's `uri` is not a string")),
            None if index == 0 && is_glb(&upload.bytes) => bin.map(Cow::Borrowed),
            None if compression::is_fallback(buffer) || length > undefined => None,
            None => {
                undefined -= length;
                Some(Cow::Owned(vec![0; length]))
            }
        };
        // Cut the bytes to the stated length.
        let short = || invalid(format!("buffers[{index}] is shorter than its `byteLength`"));
        buffers.push(match bytes {
            Some(Cow::Borrowed(bytes)) => {
                Some(Cow::Borrowed(bytes.get(..length).ok_or_else(short)?))
            }
            Some(Cow::Owned(bytes)) if bytes.len() < length => return Err(short()),
            Some(Cow::Owned(mut bytes)) => {
                bytes.truncate(length);
                Some(Cow::Owned(bytes))
            }
            None => None,
        });
    }
    Ok(buffers)
}

/// Returns the bytes of a buffer to which `part`, a view or a compressed view, refers.
fn slice<'a>(part: &Value, buffers: &'a [Buffer]) -> Result<&'a [u8], DocumentError> {
    let offset = unsigned(part, "byteOffset")?.unwrap_or(0);
    let length = required(part, "byteLength")?;
    buffers
        .get(required(part, "buffer")?)
        .ok_or_else(|| invalid("its buffer does not exist"))?
        .as_deref()
        .ok_or_else(|| invalid("its buffer has no data"))?
        .get(offset..)
        .and_then(|bytes| bytes.get(..length))
        .ok_or_else(|| invalid("it reaches beyond its buffer"))
}

fn relocate(
    view: &mut Value,
    buffers: &[Buffer],
    bases: &[Option<usize>],
) -> Result<(), DocumentError> {
    slice(view, buffers)?;
    let base = bases.get(required(view, "buffer")?).copied().flatten();
    let offset = unsigned(view, "byteOffset")?.unwrap_or(0);
    let view = object_mut(view)?;
    view.insert("buffer".to_owned(), json!(0));
    if let Some(base @ 1..) = base {
        view.insert("byteOffset".to_owned(), json!(base + offset));
    }
    Ok(())
}

/// Reserves space for all compressed views; refuses views that together claim too much for their compressed bytes.
fn reserve(body: &mut GltfBody, json: &Value, buffers: &[Buffer]) -> Result<(), DocumentError> {
    let (mut claimed, mut aligned) = (0_usize, 0);
    for view in items(json, "bufferViews")? {
        if let Some((_, extension)) = compression::of_view(view) {
            claimed = claimed.saturating_add(compression::claimed_size(extension)?);
            aligned += 4;
        }
    }
    let present = buffers.iter().flatten().map(|buffer| buffer.len()).sum();
    if claimed > most_decoded(present) {
        return Err(DocumentError::LimitExceeded(format!(
            "compressed buffer views of {present} bytes claim to hold {claimed}"
        )));
    }
    body.bin.reserve_exact(claimed + aligned);
    Ok(())
}

fn decode(view: &mut Value, buffers: &[Buffer], body: &mut GltfBody) -> Result<(), DocumentError> {
    let Some((name, extension)) = compression::of_view(view) else {
        return Ok(());
    };
    let decoded = compression::decode_view(extension, slice(extension, buffers)?)?;
    if required(view, "byteLength")? > decoded.len() {
        return Err(invalid("it is longer than what its compressed data holds"));
    }
    remove_extension(view, name);
    let view = object_mut(view)?;
    view.insert("buffer".to_owned(), json!(0));
    view.insert("byteOffset".to_owned(), json!(body.push_bytes(&decoded)));
    Ok(())
}

// The GLB container: a header, a JSON chunk, a binary chunk, unknown chunks.

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
pub(super) fn glb_of(
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

// Files to which a glTF refers, for callers that gather them.

/// Returns the relative paths of the buffers and images to which a glTF file refers, as
/// [`Upload::resources`](crate::document::Upload) names them. Empty for any other content; data URIs, absolute paths,
/// schemes and paths that leave the folder are left out.
pub fn references(bytes: &[u8]) -> Vec<String> {
    let json = if is_glb(bytes) {
        split(bytes).map_or(&[][..], |container| container.json)
    } else {
        without_mark(bytes)
    };
    let root = parse(json).unwrap_or_default();
    let members = ["buffers", "images"].map(|key| root[key].as_array());
    let mut paths: Vec<String> = members
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|member| member["uri"].as_str())
        .filter(|text| !uri::is_data(text))
        .flat_map(uri::candidates)
        .collect();
    paths.sort();
    paths.dedup();
    paths
}
