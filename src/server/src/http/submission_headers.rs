//! Request headers of a submission.

use axum::http::{HeaderMap, header};

use super::observation::traceparent;
use super::problem::{Code, Problem};

/// Maximum length of an Idempotency-Key, by convention: other APIs, such as Stripe's, have the same limit.
const MAX_KEY: usize = 255;

/// Settings of a submission from its headers.
pub(super) struct SubmissionHeaders {
    /// Idempotency key.
    pub key: Option<String>,
    /// Set unless the client refuses the result of an equal job.
    pub reuse: bool,
    /// Trace that the client is part of.
    pub trace: Option<String>,
}

impl SubmissionHeaders {
    /// Parses `Idempotency-Key`, `Cache-Control` and `traceparent`.
    pub fn read(headers: &HeaderMap) -> Result<Self, Problem> {
        let directives = headers.get_all(header::CACHE_CONTROL).iter();
        let mut directives = directives
            .filter_map(|value| value.to_str().ok())
            .flat_map(|value| value.split(','));
        let is_refusal = |directive: &str| directive.trim().eq_ignore_ascii_case("no-cache");
        Ok(Self {
            key: idempotency_key(headers)?,
            reuse: !directives.any(is_refusal),
            trace: traceparent(headers),
        })
    }
}

fn idempotency_key(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let Some(value) = headers.get("idempotency-key") else {
        return Ok(None);
    };
    match value.to_str() {
        Ok(key) if (1..=MAX_KEY).contains(&key.len()) => Ok(Some(key.to_owned())),
        _ => Err(Problem::new(
            Code::InvalidRequest,
            format!("Idempotency-Key must have 1 to {MAX_KEY} visible characters"),
        )),
    }
}
