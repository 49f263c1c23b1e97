//! Failures outside of the work itself. The other codes of a summary are those of the service.

use std::io;
use unwrapd_api::Failure;

/// Reason for a missing output although the work may have been done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// The job was cancelled.
    Cancelled,
    /// The input or a folder on its path cannot be read.
    InputUnreadable,
    /// A file to be written exists and belongs to another output.
    OutputConflict,
    /// A file cannot be written.
    OutputUnwritable,
    /// The service does not respond, or not properly.
    ServerUnavailable,
}

impl Trouble {
    /// Returns its code in summaries.
    pub fn word(self) -> &'static str {
        match self {
            Self::Cancelled => "cancelled",
            Self::InputUnreadable => "input_unreadable",
            Self::OutputConflict => "output_conflict",
            Self::OutputUnwritable => "output_unwritable",
            Self::ServerUnavailable => "server_unavailable",
        }
    }

    /// Returns the failure of an asset.
    pub fn with(self, detail: impl Into<String>) -> Failure {
        Failure::new(self.word(), detail)
    }

    /// Returns the variant with this code.
    pub fn of(code: &str) -> Option<Self> {
        let all = [
            Self::Cancelled,
            Self::InputUnreadable,
            Self::OutputConflict,
            Self::OutputUnwritable,
            Self::ServerUnavailable,
        ];
        all.into_iter().find(|trouble| trouble.word() == code)
    }
}

/// Returns the failure of a file that could not be written.
pub(super) fn unwritten(error: &io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            Failure::new("storage_full", error.to_string())
        }
        _ => Trouble::OutputUnwritable.with(error.to_string()),
    }
}
