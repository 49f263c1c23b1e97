//! Failures of computations.

use std::io::ErrorKind;

use serde::{Deserialize, Serialize};

/// Cause of a failed job: a stable code and one sentence for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// Stable code in snake_case: one of the pipeline's, or `worker_lost`, `crashed`, `out_of_memory`, `timed_out`.
    pub code: String,
    /// Description in one line.
    pub detail: String,
}

impl Failure {
    /// Creates a failure from its code and its description.
    pub fn new(code: &str, detail: impl Into<String>) -> Self {
        Self {
            code: code.to_owned(),
            detail: detail.into(),
        }
    }
}

/// Converts the error of a folder of a computation, or of its process.
impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        let code = match error.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "storage_full",
            _ => "internal_error",
        };
        Self::new(code, error.to_string())
    }
}
