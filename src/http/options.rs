//! Options of a job, from a JSON part and query parameters, which mean the same.

use axum::extract::Query;
use axum::http::Uri;
use serde_json::{Map, Value};

use super::problem::{Code, Problem};
use crate::jobs::Kind;
use crate::pipeline;

/// What the query of an upload says.
#[derive(Default)]
pub(super) struct UploadQuery {
    /// Which job to make.
    pub kind: Option<Kind>,
    /// Name of the file in a raw body.
    pub filename: Option<String>,
    /// Everything else.
    pub options: Map<String, Value>,
}

impl UploadQuery {
    /// Reads the query. Numbers and truth values are taken as such, everything else is text.
    pub fn read(uri: &Uri) -> Result<Self, Problem> {
        let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri)
            .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
        let mut query = Self::default();
        for (name, text) in pairs {
            let is_new = match name.as_str() {
                "kind" => query.kind.replace(kind(&text)?).is_none(),
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
        let detail = format!("there is no kind {text:?}: unwrap or measure");
        Problem::new(Code::InvalidRequest, detail)
    })
}

fn value(text: String) -> Value {
    match serde_json::from_str(&text) {
        Ok(value @ (Value::Number(_) | Value::Bool(_))) => value,
        _ => Value::String(text),
    }
}

/// Checks options, and completes them with defaults.
pub(super) fn complete(kind: Kind, given: Map<String, Value>) -> Result<Value, Problem> {
    let refused = |detail: String| Problem::new(Code::InvalidOptions, detail);
    let given = Value::Object(given);
    let complete = match kind {
        Kind::Unwrap => {
            let options: pipeline::Options =
                serde_json::from_value(given).map_err(|e| refused(e.to_string()))?;
            options.validate().map_err(refused)?;
            serde_json::to_value(options)
        }
        Kind::Measure => {
            let options: pipeline::MeasureOptions =
                serde_json::from_value(given).map_err(|e| refused(e.to_string()))?;
            serde_json::to_value(options)
        }
    };
    complete.map_err(|error| Problem::internal(&error))
}
