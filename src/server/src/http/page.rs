//! The pages for people, and how static files are sent. `page/build.mjs` builds them from the sources beside it, and the binary embeds them.

use std::io::Write as _;
use std::sync::OnceLock;

use axum::extract::RawQuery;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use flate2::Compression;
use flate2::write::GzEncoder;
use sha2::{Digest, Sha256};

use super::download::names;
use super::extract::PathName;
use super::problem::{Code, Problem};

static INDEX: StaticAsset = StaticAsset::new(
    "text/html; charset=utf-8",
    include_bytes!("page/dist/index.html"),
);
static DOCS: StaticAsset = StaticAsset::new(
    "text/html; charset=utf-8",
    include_bytes!("page/dist/docs.html"),
);

const SCRIPT: &str = "text/javascript; charset=utf-8";
const WASM: &str = "application/wasm";
const STYLE: &str = "text/css; charset=utf-8";
const TEXT: &str = "text/plain; charset=utf-8";

/// Assets of the pages by name.
static ASSETS: [(&str, StaticAsset); 12] = [
    (
        "page.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/page.js")),
    ),
    (
        "chunk.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/chunk.js")),
    ),
    (
        "demand.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/demand.js")),
    ),
    (
        "draco_wasm_wrapper.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/draco_wasm_wrapper.js")),
    ),
    (
        "draco_decoder.wasm",
        StaticAsset::new(WASM, include_bytes!("page/dist/draco_decoder.wasm")),
    ),
    (
        "decoders.txt",
        StaticAsset::new(TEXT, include_bytes!("page/dist/decoders.txt")),
    ),
    (
        "worker.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/worker.js")),
    ),
    (
        "docs.js",
        StaticAsset::new(SCRIPT, include_bytes!("page/dist/docs.js")),
    ),
    (
        "page.css",
        StaticAsset::new(STYLE, include_bytes!("page/dist/page.css")),
    ),
    (
        "docs.css",
        StaticAsset::new(STYLE, include_bytes!("page/dist/docs.css")),
    ),
    (
        "viewer.txt",
        StaticAsset::new(TEXT, include_bytes!("page/dist/viewer.txt")),
    ),
    (
        "sample.ply",
        StaticAsset::new(
            "application/octet-stream",
            include_bytes!("page/sample.ply"),
        ),
    ),
];

/// Serves `/`: the page for unwrapping meshes and viewing results.
pub(super) async fn index(headers: HeaderMap) -> Response {
    answer(&INDEX, None, &headers)
}

/// Serves `/docs`: the OpenAPI document for people.
pub(super) async fn docs(headers: HeaderMap) -> Response {
    answer(&DOCS, None, &headers)
}

/// Serves `/assets/{name}`: an asset of the pages.
pub(super) async fn asset(
    PathName(name): PathName,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Response {
    match ASSETS.iter().find(|(known, _)| *known == name) {
        Some((_, asset)) => answer(asset, query.as_deref(), &headers),
        None => Problem::new(Code::NotFound, "no such asset").into_response(),
    }
}

// Static files of the binary: compressed, and cached by clients until they change.

/// Caching of versioned addresses: for good.
const FOR_GOOD: &str = "public, max-age=31536000, immutable";
/// Caching of other addresses: clients revalidate each time.
const ASK: &str = "no-cache";

/// A file of the binary with its derived data.
pub(super) struct StaticAsset {
    content_type: &'static str,
    content: &'static [u8],
    made: OnceLock<PreparedAsset>,
}

/// Data derived from a file on its first request.
struct PreparedAsset {
    /// First 16 hexadecimal digits of its SHA-256, which pages use as its version.
    version: String,
    gzip: Vec<u8>,
}

impl StaticAsset {
    pub const fn new(content_type: &'static str, content: &'static [u8]) -> Self {
        Self {
            content_type,
            content,
            made: OnceLock::new(),
        }
    }

    fn made(&self) -> &PreparedAsset {
        self.made.get_or_init(|| {
            let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
            let written = encoder.write_all(self.content);
            let mut version = format!("{:x}", Sha256::digest(self.content));
            version.truncate(16);
            PreparedAsset {
                version,
                gzip: written.and_then(|()| encoder.finish()).unwrap_or_default(),
            }
        })
    }
}

/// Responds with the file, or that it is unchanged. A query `v=` with the present version allows caching for good.
pub(super) fn answer(
    asset: &'static StaticAsset,
    query: Option<&str>,
    headers: &HeaderMap,
) -> Response {
    // Choose the representation and its entity tag.
    let made = asset.made();
    let is_compressed = !made.gzip.is_empty() && accepts_gzip(headers);
    let suffix = if is_compressed { "-gzip" } else { "" };
    let tag = format!("\"{}{suffix}\"", made.version);
    let is_versioned = query.and_then(|query| query.strip_prefix("v=")) == Some(&made.version);
    let kept = if is_versioned { FOR_GOOD } else { ASK };
    // Send it, unless the client has it.
    let mut response = if names(headers, header::IF_NONE_MATCH, &tag) {
        StatusCode::NOT_MODIFIED.into_response()
    } else if is_compressed {
        let encoding = [(header::CONTENT_ENCODING, "gzip")];
        (encoding, made.gzip.as_slice()).into_response()
    } else {
        asset.content.into_response()
    };
    // Set the headers, on a 304 as well, so that clients update their copy (RFC 9110, 15.4.5).
    let set = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_TYPE, asset.content_type),
        (header::CACHE_CONTROL, kept),
        (header::VARY, "accept-encoding"),
    ] {
        set.insert(name, HeaderValue::from_static(value));
    }
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        set.insert(header::ETAG, tag);
    }
    response
}

/// Returns whether a client accepts gzip with a nonzero weight.
fn accepts_gzip(headers: &HeaderMap) -> bool {
    headers
        .get_all(header::ACCEPT_ENCODING)
        .iter()
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split(','))
        .filter_map(|coding| coding.trim().strip_prefix("gzip"))
        .any(|rest| !matches!(rest.trim().trim_end_matches(['0', '.']), ";q="))
}
