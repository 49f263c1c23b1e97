//! Why a store did not do what it was asked.

use std::io::{Error, ErrorKind};
use std::path::Path;

/// The store did not do what it was asked. Each holds one line for the log.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StoreError {
    /// There is no space for it. Deleting still works.
    #[error("no space left: {0}")]
    Full(String),
    /// Somebody else changed what it was to change.
    #[error("changed meanwhile: {0}")]
    Conflict(String),
    /// It cannot be reached, or it is too busy. The same may work later.
    #[error("not available: {0}")]
    Unavailable(String),
    /// It may have done it or not: the answer did not come.
    #[error("not answered: {0}")]
    Unanswered(String),
    /// What it returned is not what was stored.
    #[error("damaged: {0}")]
    Damaged(String),
    /// A file that was stored is not there.
    #[error("missing: {0}")]
    Missing(String),
    /// A file or a folder cannot be used.
    #[error("{path}: {why}")]
    File {
        /// Where it is.
        path: String,
        /// Why not.
        why: String,
    },
    /// Nothing that waiting would mend.
    #[error("{0}")]
    Other(String),
}

/// What store operations return.
pub type StoreResult<T> = Result<T, StoreError>;

impl StoreError {
    /// Whether the same may work later without anybody changing the request.
    pub fn is_passing(&self) -> bool {
        matches!(
            self,
            Self::Full(_) | Self::Unavailable(_) | Self::Unanswered(_)
        )
    }
}

impl StoreError {
    /// That a file which was stored is not there.
    pub fn missing() -> Self {
        Self::Missing("a stored file is missing".to_owned())
    }

    /// Whether what was stored is not there, or is not what was stored.
    pub fn is_loss(&self) -> bool {
        matches!(self, Self::Damaged(_) | Self::Missing(_))
    }

    /// That something could not be done with the file or folder at a path.
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
