//! Options, by the names and types of the service.

use napi_derive::napi;
use serde::Serialize;
use serde::de::DeserializeOwned;
use unwrapd::options::OptionSet;
use unwrapd::pipeline::{Options, PipelineError};

use crate::call::Failure;

/// The names of the options of a file that is unwrapped.
#[napi]
pub fn option_names() -> Vec<&'static str> {
    Options::names()
}

/// The options in a JSON object that has no others.
pub fn parsed<O: DeserializeOwned>(json: &str) -> Result<O, Failure> {
    serde_json::from_str(json)
        .map_err(|error| PipelineError::InvalidOptions(error.to_string()).into())
}

/// A report as JSON.
pub fn json<T: Serialize>(report: &T) -> Result<String, Failure> {
    serde_json::to_string(report).map_err(|error| Failure::internal(error.to_string()))
}
