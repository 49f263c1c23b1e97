//! Errors of stores.

use std::io::{Error, ErrorKind};
use std::path::Path;

/// Error of a store. Each variant holds one line for the log.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StoreError {
    /// There is no space left. Deleting still works.
    #[error("no space left: {0}")]
    Full(String),
    /// The target was changed concurrently.
    #[error("changed meanwhile: {0}")]
    Conflict(String),
    /// The store is unreachable or too busy. A retry may succeed.
    #[error("not available: {0}")]
    Unavailable(String),
    /// The answer was lost, so the operation may or may not have happened.
    #[error("not answered: {0}")]
    Unanswered(String),
    /// The content read is not what was stored.
    #[error("damaged: {0}")]
    Damaged(String),
    /// A stored file is missing.
    #[error("missing: {0}")]
    Missing(String),
    /// A file or a folder cannot be used.
    #[error("{path}: {why}")]
    File {
        /// Its path.
        path: String,
        /// The reason.
        why: String,
    },
    /// Any other error, which a retry would not fix.
    #[error("{0}")]
    Other(String),
}

/// Result of a store operation.
pub type StoreResult<T> = Result<T, StoreError>;

impl StoreError {
    /// Returns whether the same request may succeed later.
    pub fn is_passing(&self) -> bool {
        matches!(
            self,
            Self::Full(_) | Self::Unavailable(_) | Self::Unanswered(_)
        )
    }
}

impl StoreError {
    /// Returns the error of a stored file that is missing.
    pub fn missing() -> Self {
        Self::Missing("a stored file is missing".to_owned())
    }

    /// Returns whether stored content is missing or damaged.
    pub fn is_loss(&self) -> bool {
        matches!(self, Self::Damaged(_) | Self::Missing(_))
    }

    /// Converts I/O errors of the file or folder at a path.
    pub fn at(path: &Path) -> impl FnOnce(Error) -> Self + use<> {
        let path = path.display().to_string();
        move |error| match error.into() {
            Self::Other(why) => Self::File { path, why },
            other => other,
        }
    }
}

impl From<Error> for StoreError {
    fn from(error: Error) -> Self {
        match error.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Self::Full(error.to_string()),
            _ => Self::Other(error.to_string()),
        }
    }
}
