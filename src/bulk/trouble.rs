//! What keeps an asset from its output beside the work itself. The other codes of a summary are those
//! of the service.

use std::io;
use unwrapd_api::Failure;

/// Why there is no output although the work may have been done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// Somebody cancelled the job.
    Cancelled,
    /// The input or a folder on its way cannot be read.
    InputUnreadable,
    /// A file that would be written is there and belongs to another output.
    OutputConflict,
    /// A file cannot be written.
    OutputUnwritable,
    /// The service does not answer, or not as it should.
    ServerUnavailable,
}

impl Trouble {
    /// Its code in summaries.
    pub fn word(self) -> &'static str {
        match self {
            Self::Cancelled => "cancelled",
            Self::InputUnreadable => "input_unreadable",
            Self::OutputConflict => "output_conflict",
            Self::OutputUnwritable => "output_unwritable",
            Self::ServerUnavailable => "server_unavailable",
        }
    }

    /// As the end of an asset.
    pub fn with(self, detail: impl Into<String>) -> Failure {
        Failure::new(self.word(), detail)
    }

    /// Of a code.
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

/// Why a file is not in its place.
pub(super) fn unwritten(error: &io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            Failure::new("storage_full", error.to_string())
        }
        _ => Trouble::OutputUnwritable.with(error.to_string()),
    }
}
