//! Buffers: found, checked, decompressed and joined into one, so that all other code sees a single array of bytes.
use super::body::Body;
use super::json::{
    array_mut, invalid, items, object_mut, remove, remove_extension, required, unsigned,
};
use super::{glb, meshopt, uri};
use crate::document::{DocumentError, Upload};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Most zeros that stand for buffers without content, which glTF allows.
const MAX_UNDEFINED: usize = 1 << 20;

/// Bytes of a buffer; `None` if the document leaves them undefined.
type Buffer<'a> = Option<Cow<'a, [u8]>>;

/// Returns the limit on the decoded size of this number of compressed bytes: far above real ratios, with a fixed
/// allowance for small streams, since a kilobyte may validly describe millions of points.
pub(super) fn most_decoded(compressed: usize) -> usize {
    const FEW: usize = 256 << 20;
    const MANY: usize = 1 << 31;
    const RATIO: usize = 64;
    compressed.saturating_mul(RATIO).clamp(FEW, MANY)
}

/// Joins all buffers of the document into `buffers[0]`. The first keeps its place; views move with their bytes; views
/// compressed with meshopt get their decoded bytes; fallback buffers that nothing else needs are dropped.
pub(super) fn join(
    mut json: Value,
    bin: Option<&[u8]>,
    upload: &Upload,
) -> Result<Body, DocumentError> {
    let buffers = load(&json, bin, upload)?;
    // Buffers that views other than compressed ones need.
    let views = items(&json, "bufferViews")?;
    let mut needed: Vec<bool> = items(&json, "buffers")?
        .iter()
        .map(|buffer| !meshopt::is_fallback(buffer))
        .collect();
    for view in views.iter().filter(|view| meshopt::of_view(view).is_none()) {
        let buffer = required(view, "buffer")?;
        *needed
            .get_mut(buffer)
            .ok_or_else(|| invalid(format!("buffers[{buffer}] does not exist")))? = true;
    }
    let mut body = Body {
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
        let moved = if meshopt::of_view(view).is_some() {
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
        for name in meshopt::NAMES {
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
                Err(DocumentError::MissingResource(_)) if meshopt::is_fallback(buffer) => None,
                resolved => Some(resolved?),
            },
            Some(_) => return Err(invalid("a buffer's `uri` is not a string")),
            None if index == 0 && glb::is_glb(&upload.bytes) => bin.map(Cow::Borrowed),
            None if meshopt::is_fallback(buffer) || length > undefined => None,
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
fn reserve(body: &mut Body, json: &Value, buffers: &[Buffer]) -> Result<(), DocumentError> {
    let (mut claimed, mut aligned) = (0_usize, 0);
    for view in items(json, "bufferViews")? {
        if let Some((_, extension)) = meshopt::of_view(view) {
            claimed = claimed.saturating_add(meshopt::claimed_size(extension)?);
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

fn decode(view: &mut Value, buffers: &[Buffer], body: &mut Body) -> Result<(), DocumentError> {
    let Some((name, extension)) = meshopt::of_view(view) else {
        return Ok(());
    };
    let decoded = meshopt::decode(extension, slice(extension, buffers)?)?;
    if required(view, "byteLength")? > decoded.len() {
        return Err(invalid("it is longer than what its compressed data holds"));
    }
    remove_extension(view, name);
    let view = object_mut(view)?;
    view.insert("buffer".to_owned(), json!(0));
    view.insert("byteOffset".to_owned(), json!(body.push_bytes(&decoded)));
    Ok(())
}
