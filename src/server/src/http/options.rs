//! Options of a job from a JSON part and query parameters, which are equivalent.

use axum::extract::Query;
use axum::http::Uri;
use serde_json::{Map, Value};

use super::handling::{HandlingBuilder, once};
use super::problem::{Code, Problem};
use unwrapd_api::{Catalog, Kind, from_json};

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
                "kind" => query.kind.replace(kind(&text)?).is_none(),
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
pub(super) fn kind(text: &str) -> Result<Kind, Problem> {
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
pub(super) fn complete(
    catalog: &dyn Catalog,
    kind: Kind,
    given: Map<String, Value>,
) -> Result<Value, Problem> {
    let completed = catalog.complete(kind, Value::Object(given));
    completed.map_err(|refused| Problem::of_failure(&refused.failure).with_column(refused.column))
}
