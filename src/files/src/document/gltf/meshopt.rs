//! `EXT_meshopt_compression` and `KHR_meshopt_compression`: buffer views in the codecs of meshoptimizer.
//!
//! The decoders are C++ behind a foreign function interface, since the stride is known only at run time. They are
//! documented as safe for untrusted input if the output has the promised size, the strides are those of the format and
//! the pointers are valid; this file checks exactly that before each call.
use super::json::{extension, invalid, required};
use crate::document::DocumentError;
use ::meshopt::ffi;
use serde_json::Value;
use std::ffi::c_void;

/// Both names of the extension.
pub(super) const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Largest compression ratio of the codecs: 256 vertices of four constant bytes each in one byte.
const MAX_RATIO: usize = 1024;

/// Returns the extension of a buffer view and its name.
pub(super) fn of_view(view: &Value) -> Option<(&'static str, &Value)> {
    NAMES
        .into_iter()
        .find_map(|name| Some((name, extension(view, name)?)))
}

/// Returns whether a buffer serves only readers that do not know the extension.
pub(super) fn is_fallback(buffer: &Value) -> bool {
    NAMES.into_iter().any(|name| {
        extension(buffer, name)
            .and_then(|extension| extension.get("fallback"))
            .is_some_and(|fallback| fallback == &Value::Bool(true))
    })
}

#[derive(Clone, Copy)]
enum MeshoptMode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// Returns the number of bytes that a compressed view claims to represent.
pub(super) fn claimed_size(extension: &Value) -> Result<usize, DocumentError> {
    let (count, stride) = (
        required(extension, "count")?,
        required(extension, "byteStride")?,
    );
    Ok(count.saturating_mul(stride))
}

/// Returns the decoded bytes of a compressed view.
pub(super) fn decode(extension: &Value, data: &[u8]) -> Result<Vec<u8>, DocumentError> {
    let text = |key| extension.get(key).and_then(Value::as_str);
    // Check what the decoders require: mode, filter, count and stride.
    let mode = match text("mode") {
        Some("ATTRIBUTES") => MeshoptMode::Attributes,
        Some("TRIANGLES") => MeshoptMode::Triangles,
        Some("INDICES") => MeshoptMode::Indices,
        _ => return Err(invalid("unknown meshopt `mode`")),
    };
    let filter = match text("filter") {
        None | Some("NONE") => Filter::None,
        Some("OCTAHEDRAL") => Filter::Octahedral,
        Some("QUATERNION") => Filter::Quaternion,
        Some("EXPONENTIAL") => Filter::Exponential,
        Some("COLOR") => Filter::Color,
        Some(_) => return Err(invalid("unknown meshopt `filter`")),
    };
    let count = required(extension, "count")?;
    let stride = required(extension, "byteStride")?;
    let fits = match (mode, filter) {
        (MeshoptMode::Attributes, Filter::None | Filter::Exponential) => {
            (4..=256).contains(&stride) && stride % 4 == 0
        }
        (MeshoptMode::Attributes, Filter::Octahedral | Filter::Color) => stride == 4 || stride == 8,
        (MeshoptMode::Attributes, Filter::Quaternion) => stride == 8,
        (MeshoptMode::Triangles, Filter::None) => (stride == 2 || stride == 4) && count % 3 == 0,
        (MeshoptMode::Indices, Filter::None) => stride == 2 || stride == 4,
        _ => false,
    };
    if !fits {
        return Err(invalid(
            "meshopt mode, filter and stride contradict each other",
        ));
    }
    // Refuse sizes that the data cannot have before anything is allocated.
    let size = count
        .checked_mul(stride)
        .filter(|size| size / MAX_RATIO <= data.len())
        .ok_or_else(|| {
            DocumentError::LimitExceeded(
                "a compressed buffer view claims too many bytes".to_owned(),
            )
        })?;
    // Decode, reverse the filter, and take the bytes.
    let mut words = vec![0u64; size.div_ceil(8)];
    if !decode_into(&mut words, mode, count, stride, data) {
        return Err(invalid("its meshopt data is damaged"));
    }
    apply(&mut words, filter, count, stride);
    let mut bytes = Vec::with_capacity(words.len() * size_of::<u64>());
    for word in words {
        bytes.extend_from_slice(&word.to_ne_bytes());
    }
    bytes.truncate(size);
    Ok(bytes)
}

/// Decodes into `words`, which must hold `count` elements of `stride` bytes; returns `false` if the data is damaged.
#[allow(unsafe_code)]
fn decode_into(
    words: &mut [u64],
    mode: MeshoptMode,
    count: usize,
    stride: usize,
    data: &[u8],
) -> bool {
    assert!(count * stride <= size_of_val(words));
    let out = words.as_mut_ptr().cast::<c_void>();
    // SAFETY: `out` is valid for writes of count × stride bytes (asserted above) and aligned to 8; `data` is valid for
    // reads of its length, beyond which the decoders do not read: they check every access against the end and report
    // damage. The preconditions that the C++ code asserts were checked in `decode`: vertex strides are multiples of 4
    // from 4 to 256, index sizes 2 or 4, triangle counts multiples of 3. Any byte pattern is a valid u64.
    let status = unsafe {
        match mode {
            MeshoptMode::Attributes => {
                ffi::meshopt_decodeVertexBuffer(out, count, stride, data.as_ptr(), data.len())
            }
            MeshoptMode::Triangles => {
                ffi::meshopt_decodeIndexBuffer(out, count, stride, data.as_ptr(), data.len())
            }
            MeshoptMode::Indices => {
                ffi::meshopt_decodeIndexSequence(out, count, stride, data.as_ptr(), data.len())
            }
        }
    };
    status == 0
}

/// Reverses the filter in place.
#[allow(unsafe_code)]
fn apply(words: &mut [u64], filter: Filter, count: usize, stride: usize) {
    assert!(count * stride <= size_of_val(words));
    let data = words.as_mut_ptr().cast::<c_void>();
    // SAFETY: `data` is valid for reads and writes of count × stride bytes (asserted above), which is all the filters
    // touch, and aligned to 8 for the 2- and 4-byte components they access. The strides that the C++ code asserts were
    // checked in `decode`: 4 or 8 for octahedral and color, 8 for quaternion, a multiple of 4 for exponential.
    unsafe {
        match filter {
            Filter::None => {}
            Filter::Octahedral => ffi::meshopt_decodeFilterOct(data, count, stride),
            Filter::Quaternion => ffi::meshopt_decodeFilterQuat(data, count, stride),
            Filter::Exponential => ffi::meshopt_decodeFilterExp(data, count, stride),
            Filter::Color => ffi::meshopt_decodeFilterColor(data, count, stride),
        }
    }
}
