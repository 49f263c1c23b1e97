//! Request ids, logging and metrics of requests.

use axum::extract::{MatchedPath, Request};
use axum::http::{HeaderMap, HeaderName, HeaderValue};
use axum::middleware::Next;
use axum::response::Response;
use metrics::{Unit, counter, describe_counter, describe_histogram, histogram};
use tokio::time::Instant;
use tracing::Instrument;

use crate::jobs::JobId;

/// Header with the id of a request, in both directions.
pub(super) const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
/// Maximum length of a client's request id in characters: room for a UUID or a trace id with a prefix. Longer ids
/// would let clients fill the log.
const LONGEST_ID: usize = 64;
/// Header with the trace that a request is part of (W3C Trace Context).
const TRACE: &str = "traceparent";

const REQUESTS: &str = "unwrapd_http_requests_total";
const SECONDS: &str = "unwrapd_http_request_seconds";

/// Describes the metrics.
pub(super) fn describe() {
    describe_counter!(REQUESTS, "Requests answered");
    let meaning = "Until the head of the answer was there";
    describe_histogram!(SECONDS, Unit::Seconds, meaning);
}

/// Runs a request under its id, and logs and counts it.
pub(super) async fn observe(request: Request, next: Next) -> Response {
    // Run the request in a span with its id.
    let id = request_id(request.headers());
    let route = request.extensions().get::<MatchedPath>();
    let route = route.map_or("", MatchedPath::as_str).to_owned();
    let (method, path) = (request.method().clone(), request.uri().path().to_owned());
    let trace = traceparent(request.headers());
    let span = tracing::info_span!("request", id, %method, path, trace = trace.as_deref());
    let began = Instant::now();
    let mut response = next.run(request).instrument(span.clone()).await;
    let (seconds, status) = (began.elapsed().as_secs_f64(), response.status().as_u16());
    // Log the answer, count it and record its time.
    span.in_scope(|| {
        if status < 500 {
            tracing::debug!(status, seconds, "answered");
        } else {
            tracing::warn!(status, seconds, "answered");
        }
    });
    let (method, status) = (word(method.as_str()), status.to_string());
    counter!(REQUESTS, "method" => method, "route" => route.clone(), "status" => status)
        .increment(1);
    histogram!(SECONDS, "method" => method, "route" => route).record(seconds);
    // Tell the client the id.
    if let Ok(id) = HeaderValue::from_str(&id) {
        response.headers_mut().insert(REQUEST_ID, id);
    }
    response
}

/// Returns a known method, or "other" to keep the number of metrics bounded.
fn word(method: &str) -> &'static str {
    let known = ["GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH"];
    let mut known = known.into_iter();
    known.find(|it| *it == method).unwrap_or("other")
}

/// Returns the client's id of a request if it is well-formed, otherwise a fresh one.
fn request_id(headers: &HeaderMap) -> String {
    let given = headers.get(REQUEST_ID).and_then(|id| id.to_str().ok());
    let given = given.filter(|id| {
        (1..=LONGEST_ID).contains(&id.len())
            && (id.chars()).all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c))
    });
    given.map_or_else(|| JobId::fresh().to_string(), str::to_owned)
}

/// Returns the client's trace if it is well-formed.
pub(super) fn traceparent(headers: &HeaderMap) -> Option<String> {
    let text = headers.get(TRACE)?.to_str().ok()?;
    let parts: Vec<&str> = text.split('-').collect();
    let is_whole = parts.iter().map(|part| part.len()).eq([2, 32, 16, 2])
        && parts
            .iter()
            .all(|part| part.chars().all(|c| matches!(c, '0'..='9' | 'a'..='f')))
        && parts[0] != "ff"
        && parts[1..3].iter().all(|id| id.chars().any(|c| c != '0'));
    is_whole.then(|| text.to_owned())
}
