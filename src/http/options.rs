//! Options of a job, from a JSON part and query parameters, which mean the same.

use std::ops::RangeInclusive;

use axum::extract::Query;
use axum::http::Uri;
use serde_json::{Map, Value};

use super::problem::{Code, Problem};
use crate::deform::from_json;
use crate::jobs::{Failure, Kind, Work};

/// Priorities that a client may ask for.
const PRIORITIES: RangeInclusive<i32> = -100..=100;

/// What the query of an upload says.
#[derive(Default)]
pub(super) struct UploadQuery {
    /// Which job to make.
    pub kind: Option<Kind>,
    /// Name of the file in a raw body.
    pub filename: Option<String>,
    /// How soon the job is to start.
    pub priority: Option<i32>,
    /// Everything else.
    pub options: Map<String, Value>,
}

impl UploadQuery {
    /// Reads the query.
    pub fn read(uri: &Uri) -> Result<Self, Problem> {
        let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri)
            .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
        let mut query = Self::default();
        for (name, text) in pairs {
            let is_new = match name.as_str() {
                "kind" => query.kind.replace(kind(&text)?).is_none(),
                "priority" => query.priority.replace(priority(&text)?).is_none(),
                "filename" => query.filename.replace(text).is_none(),
                _ => query.options.insert(name.clone(), value(text)).is_none(),
            };
            if !is_new {
                let detail = format!("parameter {name} is given twice");
                return Err(Problem::new(Code::InvalidRequest, detail));
            }
        }
        Ok(query)
    }
}

/// The kind of job that a word names.
pub(super) fn kind(text: &str) -> Result<Kind, Problem> {
    serde_json::from_value(text.into()).map_err(|_| {
        let words = Kind::ALL.map(Kind::word).join(", ");
        let detail = format!("unknown kind {text:?}: expected one of {words}");
        Problem::new(Code::InvalidRequest, detail)
    })
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

/// Numbers, truth values and lists as JSON, everything else as text.
fn value(text: String) -> Value {
    match from_json(text.as_bytes()) {
        Ok(value @ (Value::Number(_) | Value::Bool(_) | Value::Array(_))) => value,
        _ => Value::String(text),
    }
}

/// Checks options, and completes them with defaults.
pub(super) fn complete(kind: Kind, given: Map<String, Value>) -> Result<Value, Problem> {
    let work = Work::new(kind, Value::Object(given));
    work.map(Work::into_options)
        .map_err(|error| Problem::of_failure(&Failure::new(error.code(), error.to_string())))
}
