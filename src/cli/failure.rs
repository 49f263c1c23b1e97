//! Failures of commands: one line and an exit status.

use std::io::Write;

use super::escaping::escaped;
use crate::bulk::{ListError, RemoteError};
use unwrapd_api::options::as_typed;
use unwrapd_deform::ProblemError;
use unwrapd_deform::uv::EditError;
use unwrapd_deform::warp::WarpError;
use unwrapd_pipeline::{Completion, PipelineError};

/// Failure of a command: one line and an exit status.
#[derive(Debug)]
pub(super) struct Failure {
    exit_code: u8,
    message: String,
}

impl Failure {
    /// Creates the failure of an invalid command line (exit status 2).
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self {
            exit_code: 2,
            message: message.into(),
        }
    }

    /// Creates the failure of an unusable input (exit status 3).
    pub(super) fn input(message: impl Into<String>) -> Self {
        Self {
            exit_code: 3,
            message: message.into(),
        }
    }

    /// Creates the failure of an uncertified or rejected result (exit status 4).
    pub(super) fn uncertified(message: impl Into<String>) -> Self {
        Self {
            exit_code: 4,
            message: message.into(),
        }
    }

    /// Fails if a result was written although the work is incomplete.
    pub(super) fn unless_complete(completion: Completion) -> Result<(), Self> {
        let (exit_code, message) = match completion {
            Completion::Complete => return Ok(()),
            Completion::TargetsMissed => {
                (5, "not all targets can be reached (targets_unreachable)")
            }
            Completion::EndedEarly => (6, "the work ended before all was done (ended_early)"),
        };
        Err(Self {
            exit_code,
            message: message.to_owned(),
        })
    }

    /// Creates the failure of a partly completed request (exit status 7).
    pub(super) fn partly(message: impl Into<String>) -> Self {
        Self {
            exit_code: 7,
            message: message.into(),
        }
    }

    /// Creates any other failure (exit status 1).
    pub(super) fn other(message: impl Into<String>) -> Self {
        Self {
            exit_code: 1,
            message: message.into(),
        }
    }

    /// Prefixes the message with what was not done.
    pub(super) fn about(mut self, what: impl std::fmt::Display) -> Self {
        self.message = format!("{what}: {}", self.message);
        self
    }

    /// Prefixes the message with the unusable input, unless it is already named.
    pub(super) fn of_input(mut self, name: Option<&str>) -> Self {
        let name = name.filter(|name| !self.message.contains(name));
        if let (3, Some(name)) = (self.exit_code, name) {
            let name = if name == "-" { "standard input" } else { name };
            self.message = format!("{name}: {}", self.message);
        }
        self
    }

    /// Prints the line and returns the exit status.
    pub(super) fn report(self) -> u8 {
        let message = escaped(&self.message);
        // Standard error may be closed.
        let _ = writeln!(std::io::stderr(), "unwrapd: {message}");
        self.exit_code
    }
}

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        let text = match &error {
            PipelineError::InvalidOptions(text) => typed(text),
            _ => error.to_string(),
        };
        Self {
            exit_code: error.exit_code(),
            message: format!("{text} ({})", error.code()),
        }
    }
}

impl Failure {
    /// Converts the rejection of options, with option names as they are typed.
    pub(super) fn of_options(error: PipelineError) -> Self {
        let code = error.code();
        Self {
            message: format!("{} ({code})", typed(&error.to_string())),
            ..error.into()
        }
    }
}

impl From<RemoteError> for Failure {
    fn from(error: RemoteError) -> Self {
        match error {
            RemoteError::Address { .. } | RemoteError::Key => Self::usage(error.to_string()),
            RemoteError::NoService { .. } => Self::other(error.to_string()),
        }
    }
}

impl From<ListError> for Failure {
    fn from(error: ListError) -> Self {
        Self {
            exit_code: error.exit_code(),
            message: error.to_string(),
        }
    }
}

/// Replaces option names in a message of the library by their typed form.
fn typed(text: &str) -> String {
    as_typed(text, |_| true)
}

/// Implements the conversion from errors of handles and problem files.
macro_rules! input_errors {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                PipelineError::from(error).into()
            }
        })*
    };
}

input_errors!(ProblemError, WarpError, EditError);
