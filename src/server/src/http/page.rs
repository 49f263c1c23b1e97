//! The pages for people. `page/build.mjs` builds them from the sources beside it, and the binary embeds them.

use axum::extract::RawQuery;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};

use super::assets::{self, Asset};
use super::extract::PathName;
use super::problem::{Code, Problem};

static INDEX: Asset = Asset::new(
    "text/html; charset=utf-8",
    include_bytes!("page/dist/index.html"),
);
static DOCS: Asset = Asset::new(
    "text/html; charset=utf-8",
    include_bytes!("page/dist/docs.html"),
);

const SCRIPT: &str = "text/javascript; charset=utf-8";
const STYLE: &str = "text/css; charset=utf-8";
const TEXT: &str = "text/plain; charset=utf-8";

/// Assets of the pages by name.
static ASSETS: [(&str, Asset); 7] = [
    (
        "page.js",
        Asset::new(SCRIPT, include_bytes!("page/dist/page.js")),
    ),
    (
        "worker.js",
        Asset::new(SCRIPT, include_bytes!("page/dist/worker.js")),
    ),
    (
        "docs.js",
        Asset::new(SCRIPT, include_bytes!("page/dist/docs.js")),
    ),
    (
        "page.css",
        Asset::new(STYLE, include_bytes!("page/dist/page.css")),
    ),
    (
        "docs.css",
        Asset::new(STYLE, include_bytes!("page/dist/docs.css")),
    ),
    (
        "viewer.txt",
        Asset::new(TEXT, include_bytes!("page/dist/viewer.txt")),
    ),
    (
        "sample.ply",
        Asset::new(
            "application/octet-stream",
            include_bytes!("page/sample.ply"),
        ),
    ),
];

/// Serves `/`: the page for unwrapping meshes and viewing results.
pub(super) async fn index(headers: HeaderMap) -> Response {
    assets::answer(&INDEX, None, &headers)
}

/// Serves `/docs`: the OpenAPI document for people.
pub(super) async fn docs(headers: HeaderMap) -> Response {
    assets::answer(&DOCS, None, &headers)
}

/// Serves `/assets/{name}`: an asset of the pages.
pub(super) async fn asset(
    PathName(name): PathName,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Response {
    match ASSETS.iter().find(|(known, _)| *known == name) {
        Some((_, asset)) => assets::answer(asset, query.as_deref(), &headers),
        None => Problem::new(Code::NotFound, "no such asset").into_response(),
    }
}
