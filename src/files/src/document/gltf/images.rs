//! Images outside the document.

use super::body::{GltfBody, Target};
use super::json::{array_mut, extension, item, item_mut, items, remove, required, unsigned};
use crate::document::{DocumentError, uri};
use crate::io::{Content, Format, detect, format_of_content};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Extension of textures with a `WebP` image.
pub(super) const WEBP: &str = "EXT_texture_webp";

/// Extension of textures with a KTX2 image.
pub(super) const KTX2: &str = "KHR_texture_basisu";

/// Returns the image of a texture that can be read: its `WebP` image, which renderers prefer, or else its own.
pub(super) fn source(texture: &Value) -> Result<Option<usize>, DocumentError> {
    let webp = extension(texture, WEBP);
    let webp = webp.map(|webp| unsigned(webp, "source")).transpose()?;
    match webp.flatten() {
        Some(image) => Ok(Some(image)),
        None => unsigned(texture, "source"),
    }
}

/// Returns the image of a texture from which it can be resampled: as [`source`], or a KTX2 image if there is no other.
pub(super) fn readable(texture: &Value) -> Result<Option<usize>, DocumentError> {
    let ktx2 = extension(texture, KTX2);
    match (source(texture)?, ktx2) {
        (None, Some(ktx2)) => unsigned(ktx2, "source"),
        (image, _) => Ok(image),
    }
}

/// Returns a texture that shows an image, given its file. A `WebP` image needs an extension, which is then listed.
pub(super) fn texture(
    json: &mut Value,
    image: usize,
    sampler: usize,
    file: &[u8],
) -> Result<Value, DocumentError> {
    if format_of_content(file, file.len() as u64, Content::Texture) != Some(Format::Webp) {
        return Ok(json!({"sampler": sampler, "source": image}));
    }
    for list in ["extensionsUsed", "extensionsRequired"] {
        let listed = array_mut(json, list)?;
        if !listed.iter().any(|name| name == WEBP) {
            listed.push(json!(WEBP));
        }
    }
    Ok(json!({"sampler": sampler, "extensions": {WEBP: {"source": image}}}))
}

/// Returns for each image the first one with the same bytes; itself if it cannot be read.
pub(super) fn first_of_equals(
    body: &GltfBody,
    resources: &BTreeMap<String, Vec<u8>>,
) -> Result<Vec<usize>, DocumentError> {
    let mut known: HashMap<Cow<[u8]>, usize> = HashMap::new();
    let n_images = items(&body.json, "images")?.len();
    Ok((0..n_images)
        .map(|index| match bytes(body, index, resources) {
            Ok(bytes) => *known.entry(bytes).or_insert(index),
            Err(_) => index,
        })
        .collect())
}

/// Returns the resources to which images refer.
pub(super) fn supplied(
    json: &Value,
    resources: &BTreeMap<String, Vec<u8>>,
) -> Result<BTreeMap<String, Vec<u8>>, DocumentError> {
    let uris = items(json, "images")?.iter().filter_map(external_uri);
    let named = uris.filter_map(|uri| uri::member(&uri, resources));
    Ok(named
        .map(|(name, bytes)| (name.to_owned(), bytes.to_vec()))
        .collect())
}

/// Embeds every supplied image into the binary buffer, so that one file holds all. Returns the URIs of those that stay
/// outside.
pub(super) fn embed(
    body: &mut GltfBody,
    resources: &BTreeMap<String, Vec<u8>>,
) -> Result<Vec<String>, DocumentError> {
    let mut outside = Vec::new();
    let mut views: BTreeMap<&str, usize> = BTreeMap::new();
    for index in 0..items(&body.json, "images")?.len() {
        let Some(uri) = external_uri(&items(&body.json, "images")?[index]) else {
            continue;
        };
        let found = uri::member(&uri, resources)
            .and_then(|(name, bytes)| Some((name, bytes, mime_type(name, bytes)?)));
        let Some((name, bytes, mime_type)) = found else {
            outside.push(uri);
            continue;
        };
        let view = match views.get(name) {
            Some(view) => *view,
            None => body.push_view(bytes, None, Target::Other)?,
        };
        views.insert(name, view);
        let image = item_mut(&mut body.json, "images", index)?;
        remove(image, "uri");
        image["bufferView"] = json!(view);
        image["mimeType"] = json!(mime_type);
    }
    Ok(outside)
}

/// Files by their names, and URIs of those that were not supplied.
pub(super) type Beside = (Vec<(String, Vec<u8>)>, Vec<String>);

/// Returns the bytes of an image's file, wherever it is stored.
pub(super) fn bytes<'a>(
    body: &'a GltfBody,
    index: usize,
    resources: &'a BTreeMap<String, Vec<u8>>,
) -> Result<Cow<'a, [u8]>, DocumentError> {
    let image = item(&body.json, "images", index)?;
    match image.get("uri").and_then(Value::as_str) {
        Some(uri) => uri::resolve(uri, resources),
        None => Ok(Cow::Borrowed(body.view(required(image, "bufferView")?)?.0)),
    }
}

/// Returns the supplied images, to be written as separate files.
pub(super) fn beside(
    json: &Value,
    resources: &BTreeMap<String, Vec<u8>>,
) -> Result<Beside, DocumentError> {
    let (mut files, mut outside) = (Vec::new(), Vec::new());
    let mut names = BTreeSet::new();
    for uri in items(json, "images")?.iter().filter_map(external_uri) {
        match uri::member(&uri, resources) {
            Some((name, bytes)) if names.insert(name) => {
                files.push((name.to_owned(), bytes.to_vec()));
            }
            Some(_) => {}
            None => outside.push(uri),
        }
    }
    Ok((files, outside))
}

fn external_uri(image: &Value) -> Option<String> {
    let uri = image.get("uri")?.as_str()?;
    (!uri::is_data(uri)).then(|| uri.to_owned())
}

/// Returns the extension of a file with this content.
pub(super) fn file_extension(bytes: &[u8]) -> &'static str {
    let format = format_of_content(bytes, bytes.len() as u64, Content::Texture);
    format.map_or("bin", Format::extension)
}

/// Returns the media type by content, else by name; `None` if it is unknown, although an embedded image must have one.
fn mime_type(name: &str, bytes: &[u8]) -> Option<&'static str> {
    let format = detect(name, bytes, Content::Texture)?;
    format.media_types().first().copied()
}
