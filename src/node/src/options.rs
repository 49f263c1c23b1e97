//! Options, with the names and types of the service.

use napi_derive::napi;
use serde::Serialize;
use serde::de::DeserializeOwned;
use unwrapd::options::OptionSet;
use unwrapd::pipeline::{Options, PipelineError};

use crate::call::Failure;

/// Returns the names of the options of unwrapping a file.
#[napi]
pub fn option_names() -> Vec<&'static str> {
    Options::names()
}

/// Parses the options in a JSON object. Rejects unknown members.
pub fn parsed<O: DeserializeOwned>(json: &str) -> Result<O, Failure> {
    serde_json::from_str(json)
        .map_err(|error| PipelineError::InvalidOptions(error.to_string()).into())
}

/// Returns a report as JSON.
pub fn json<T: Serialize>(report: &T) -> Result<String, Failure> {
    serde_json::to_string(report).map_err(|error| Failure::internal(error.to_string()))
}
