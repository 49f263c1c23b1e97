//! URIs of buffers and images: data, or a member of the upload; nothing else is ever opened.

use super::Upload;
use crate::document::DocumentError;
use crate::io::detect;
use crate::io::{Content, Format};
use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Lenient Base64: exporters leave the padding out or the last bits set.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// Characters that a file name may keep unescaped in a URI.
const FILE_NAME: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'_')
    .remove(b'.')
    .remove(b'~');

/// Returns the bytes to which `uri` refers.
pub(super) fn resolve<'a>(
    uri: &str,
    resources: &'a BTreeMap<String, Vec<u8>>,
) -> Result<Cow<'a, [u8]>, DocumentError> {
    if is_data(uri) {
        return decode_data(uri).map(Cow::Owned);
    }
    member(uri, resources)
        .map(|(_, bytes)| Cow::Borrowed(bytes))
        .ok_or_else(|| DocumentError::MissingResource(shortened(uri)))
}

/// Returns name and content of the resource to which a relative `uri` refers, escaped or, as some exporters write it,
/// plain.
pub(super) fn member<'a>(
    uri: &str,
    resources: &'a BTreeMap<String, Vec<u8>>,
) -> Option<(&'a str, &'a [u8])> {
    candidates(uri)
        .find_map(|path| resources.get_key_value(&path))
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
}

/// Iterates over the possible paths of a relative `uri`: unescaped, and unchanged.
pub(super) fn candidates(uri: &str) -> impl Iterator<Item = String> {
    let decoded = percent_decode_str(uri).decode_utf8().ok();
    [decoded, Some(Cow::Borrowed(uri))]
        .into_iter()
        .flatten()
        .filter_map(|path| normalized(&path))
}

/// Returns whether the URI contains its data.
pub(super) fn is_data(uri: &str) -> bool {
    uri.get(..5)
        .is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// Returns a relative URI for a file name.
pub(in crate::document) fn encoded(name: &str) -> String {
    utf8_percent_encode(name, FILE_NAME).to_string()
}

/// Returns a path below the main file without `.` and `..`; `None` for absolute paths, schemes and paths that leave the
/// folder.
pub(in crate::document) fn normalized(path: &str) -> Option<String> {
    if path.contains([':', '\0']) {
        return None;
    }
    let path = path.replace('\\', "/");
    let mut parts = Vec::new();
    for (position, part) in path.split('/').enumerate() {
        match part {
            "" if position == 0 => return None,
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            _ => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

fn decode_data(uri: &str) -> Result<Vec<u8>, DocumentError> {
    let (header, payload) = uri[5..]
        .split_once(',')
        .ok_or_else(|| DocumentError::InvalidGltf("a data URI has no comma".to_owned()))?;
    let payload: Cow<[u8]> = percent_decode_str(payload).into();
    let is_base64 = header
        .rsplit(';')
        .next()
        .is_some_and(|last| last.eq_ignore_ascii_case("base64"));
    if is_base64 {
        BASE64
            .decode(payload)
            .map_err(|_| DocumentError::InvalidGltf("a data URI is not base64".to_owned()))
    } else {
        Ok(payload.into_owned())
    }
}

/// Returns the beginning of a URI, for messages.
fn shortened(uri: &str) -> String {
    uri.chars().filter(|c| !c.is_control()).take(120).collect()
}

/// Returns the format of the main file as a surface: by its content, else by the extension of its name.
pub fn format_of(upload: &Upload) -> Option<Format> {
    detect(&upload.name, &upload.bytes, Content::Surface)
}
