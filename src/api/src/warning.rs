//! Warnings about files and results.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

/// Something that users should know of a file that was read or written, and that is no error.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Warning {
    /// Stable snake_case word.
    pub code: Cow<'static, str>,
    /// Explanation and advice, in one or two sentences.
    pub message: String,
}

impl Warning {
    /// Creates a warning from its code and its message.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code: Cow::Borrowed(code),
            message: message.into(),
        }
    }
}
