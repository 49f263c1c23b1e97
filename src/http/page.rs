//! The pages for people. Sources and delivery are the same files.

use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::extract::PathName;
use super::problem::{Code, Problem};

const INDEX: &str = include_str!("page/index.html");
const DOCS: &str = include_str!("page/docs.html");
const STYLE: &str = include_str!("page/page.css");
const INDEX_SCRIPT: &str = include_str!("page/index.js");
const REPORT_SCRIPT: &str = include_str!("page/report.js");
const DOCS_SCRIPT: &str = include_str!("page/docs.js");

/// `/`: upload a mesh, watch it, fetch what came of it.
pub(super) async fn index() -> Response {
    text("text/html; charset=utf-8", INDEX)
}

/// `/docs`: the OpenAPI document for people.
pub(super) async fn docs() -> Response {
    text("text/html; charset=utf-8", DOCS)
}

/// What the pages load.
pub(super) async fn asset(PathName(name): PathName) -> Response {
    match name.as_str() {
        "page.css" => text("text/css; charset=utf-8", STYLE),
        "index.js" => text("text/javascript; charset=utf-8", INDEX_SCRIPT),
        "report.js" => text("text/javascript; charset=utf-8", REPORT_SCRIPT),
        "docs.js" => text("text/javascript; charset=utf-8", DOCS_SCRIPT),
        _ => Problem::new(Code::NotFound, "no such asset").into_response(),
    }
}

fn text(content_type: &'static str, content: &'static str) -> Response {
    let headers = [
        (header::CONTENT_TYPE, content_type),
        (header::CACHE_CONTROL, "no-cache"),
    ];
    (headers, content).into_response()
}
