//! A submission without its files: the options, the handling and the headers of an upload.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use axum::extract::Query;
use axum::http::{HeaderMap, Uri, header};
use serde_json::{Map, Value};

use super::observation::traceparent;
use super::problem::{Code, Problem};
use crate::jobs::access::Owner;
use crate::jobs::{Digest, GateError, Gates, Handling, Metadata, Scratch, Submission, Webhook};
use unwrapd_api::{Catalog, InputFile, Kind, from_json};

/// A received upload. Its folder is removed on drop.
pub(super) struct Received {
    pub folder: Scratch,
    pub kind: Kind,
    /// Options, complete with defaults.
    pub options: Value,
    pub files: Vec<(InputFile, PathBuf)>,
    pub handling: Handling,
}

impl Received {
    /// Returns the submission for an owner, and the folder, which must be kept until the submission is done.
    pub fn into_submission(
        self,
        owner: &Owner,
        submission_headers: SubmissionHeaders,
        ephemeral: bool,
    ) -> (Submission, Scratch) {
        let submission = Submission {
            owner: owner.clone(),
            digest: Digest::of_job(self.kind, &self.options, self.files.iter().map(|(f, _)| f)),
            kind: self.kind,
            options: self.options,
            files: self.files,
            handling: self.handling,
            trace: submission_headers.trace,
            reuse: submission_headers.reuse,
            key: submission_headers.key,
            ephemeral,
        };
        (submission, self.folder)
    }
}

// Options of a job from a JSON part and query parameters, which are equivalent.

/// Parsed query of an upload.
#[derive(Default)]
pub(super) struct UploadQuery {
    /// Kind of the job.
    pub kind: Option<Kind>,
    /// Name of the file in a raw body.
    pub filename: Option<String>,
    /// Handling settings of the job.
    pub handling: HandlingBuilder,
    /// All other parameters.
    pub options: Map<String, Value>,
}

impl UploadQuery {
    /// Parses the query.
    pub fn read(uri: &Uri) -> Result<Self, Problem> {
        let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri)
            .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
        let mut query = Self::default();
        for (name, text) in pairs {
            let is_new = match name.as_str() {
                "kind" => query.kind.replace(parse_kind(&text)?).is_none(),
                name if HandlingBuilder::NAMES.contains(&name) => {
                    query.handling.take(name, &text)?;
                    true
                }
                "filename" => query.filename.replace(text).is_none(),
                _ => query.options.insert(name.clone(), value(text)).is_none(),
            };
            once(&name, is_new)?;
        }
        Ok(query)
    }
}

/// Parses a kind of job.
pub(super) fn parse_kind(text: &str) -> Result<Kind, Problem> {
    serde_json::from_value(text.into()).map_err(|_| {
        let words = Kind::ALL.map(Kind::word).join(", ");
        let detail = format!("unknown kind {text:?}: expected one of {words}");
        Problem::new(Code::InvalidRequest, detail)
    })
}

/// Parses numbers, booleans and lists as JSON, and anything else as text.
fn value(text: String) -> Value {
    match from_json(text.as_bytes()) {
        Ok(value @ (Value::Number(_) | Value::Bool(_) | Value::Array(_))) => value,
        _ => Value::String(text),
    }
}

/// Validates options and completes them with defaults.
pub(super) fn complete_options(
    catalog: &dyn Catalog,
    kind: Kind,
    given: Map<String, Value>,
) -> Result<Value, Problem> {
    let completed = catalog.complete(kind, Value::Object(given));
    completed.map_err(|refused| Problem::of_failure(&refused.failure).with_column(refused.column))
}

// Handling settings of an upload, from the query or from form parts.

/// Permitted priorities. The OpenAPI document repeats the bounds.
const PRIORITIES: RangeInclusive<i32> = -100..=100;

/// Settings received so far.
#[derive(Default)]
pub(super) struct HandlingBuilder {
    priority: Option<i32>,
    metadata: Option<Metadata>,
    accept: Option<Gates>,
    webhook: Option<Webhook>,
}

impl HandlingBuilder {
    /// Names of the settings.
    pub const NAMES: [&str; 4] = ["priority", "metadata", "accept", "webhook"];

    /// Records the setting with one of these names.
    pub fn take(&mut self, name: &str, text: &str) -> Result<(), Problem> {
        let is_new = match name {
            "priority" => self.priority.replace(priority(text)?).is_none(),
            "accept" => self.accept.replace(gates(text)?).is_none(),
            "webhook" => self.webhook.replace(webhook(text)?).is_none(),
            _ => self.metadata.replace(metadata(text)?).is_none(),
        };
        once(name, is_new)
    }

    /// Returns the handling for a job of this kind.
    pub fn into_handling(self, kind: Kind) -> Result<Handling, Problem> {
        if let Some(gates) = &self.accept {
            gates.check(kind).map_err(|error| refused(&error))?;
        }
        Ok(Handling {
            priority: self.priority.unwrap_or_default(),
            metadata: self.metadata.unwrap_or_default(),
            accept: self.accept,
            webhook: self.webhook,
        })
    }

    /// Rejects settings that require a stored job.
    pub fn check_unkept(&self) -> Result<(), Problem> {
        let name = match self {
            Self {
                metadata: Some(_), ..
            } => "metadata",
            Self {
                accept: Some(_), ..
            } => "accept",
            Self {
                webhook: Some(_), ..
            } => "webhook",
            _ => return Ok(()),
        };
        let detail = format!("nothing is kept of this call: `{name}` needs POST /v1/jobs");
        Err(Problem::new(Code::InvalidRequest, detail))
    }
}

fn priority(text: &str) -> Result<i32, Problem> {
    let priority = text.parse().ok();
    let priority = priority.filter(|priority| PRIORITIES.contains(priority));
    priority.ok_or_else(|| {
        let (low, high) = (PRIORITIES.start(), PRIORITIES.end());
        let detail = format!("`priority` must be a whole number from {low} to {high}");
        Problem::new(Code::InvalidRequest, detail)
    })
}

fn gates(text: &str) -> Result<Gates, Problem> {
    text.parse().map_err(|error| refused(&error))
}

fn refused(error: &GateError) -> Problem {
    Problem::new(Code::InvalidRequest, format!("`accept`: {error}"))
}

fn webhook(text: &str) -> Result<Webhook, Problem> {
    let webhook = text.parse::<Webhook>();
    webhook.map_err(|error| Problem::new(Code::InvalidRequest, format!("`webhook`: {error}")))
}

/// Parses metadata from its JSON text.
pub(super) fn metadata(text: &str) -> Result<Metadata, Problem> {
    let metadata = text.parse::<Metadata>();
    metadata.map_err(|error| Problem::new(Code::InvalidRequest, error.to_string()))
}

/// Rejects a repeated setting, because one of the two would be lost.
pub(super) fn once(name: &str, is_first: bool) -> Result<(), Problem> {
    if is_first {
        return Ok(());
    }
    let detail = format!("{name} is given twice");
    Err(Problem::new(Code::InvalidRequest, detail))
}

// Request headers of a submission.

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
        Ok(Self {
            key: idempotency_key(headers)?,
            reuse: !directives.any(|it| it.trim().eq_ignore_ascii_case("no-cache")),
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
