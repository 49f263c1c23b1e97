//! Why a command ended, in one line, and its exit status.

use std::process::ExitCode;

use crate::deform::ProblemError;
use crate::deform::outline::OutlineError;
use crate::deform::uv::EditError;
use crate::deform::warp::WarpError;
use crate::mesh::ElementError;
use crate::mesh::io::ReadError;
use crate::picture::ImageError;
use crate::pipeline::PipelineError;

/// Why a command ended, in one line, and its exit status.
#[derive(Debug)]
pub(super) struct Failure {
    exit_code: u8,
    message: String,
}

impl Failure {
    /// The command was called wrongly.
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self {
            exit_code: 2,
            message: message.into(),
        }
    }

    /// The input cannot be used.
    pub(super) fn input(message: impl Into<String>) -> Self {
        Self {
            exit_code: 3,
            message: message.into(),
        }
    }

    /// Not certified.
    pub(super) fn uncertified(message: impl Into<String>) -> Self {
        Self {
            exit_code: 4,
            message: message.into(),
        }
    }

    /// Anything else.
    pub(super) fn other(message: impl Into<String>) -> Self {
        Self {
            exit_code: 1,
            message: message.into(),
        }
    }

    /// Prints the line and gives the exit status.
    pub(super) fn report(self) -> ExitCode {
        eprintln!("unwrapd: {}", self.message);
        ExitCode::from(self.exit_code)
    }
}

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        Self {
            exit_code: error.exit_code(),
            message: format!("{error} ({})", error.code()),
        }
    }
}

/// An input that cannot be used: the error's line and its code.
macro_rules! input_errors {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::input(format!("{error} ({})", error.code()))
            }
        })*
    };
}

input_errors!(
    ProblemError,
    ReadError,
    ElementError,
    OutlineError,
    ImageError,
    WarpError,
    EditError
);
