//! Output of commands: lines about the result on standard output, or on standard error if standard output carries the
//! result itself; warnings and failures on standard error.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU8, Ordering};

use crate::bulk::{ListError, RemoteError};
use unwrapd_api::options::as_typed;
use unwrapd_deform::ProblemError;
use unwrapd_deform::uv::EditError;
use unwrapd_deform::warp::WarpError;
use unwrapd_files::document::Warning;
use unwrapd_pipeline::{Completion, PipelineError};

/// Destination of lines about a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineTarget {
    /// Standard output.
    Output,
    /// Standard error, because standard output carries the result.
    Error,
    /// Nowhere.
    None,
}

/// Destination of lines, which is global like the streams.
static LINES: AtomicU8 = AtomicU8::new(LineTarget::Output as u8);

/// Sets the destination of lines.
pub(super) fn direct(lines: LineTarget) {
    LINES.store(lines as u8, Ordering::Relaxed);
}

/// Prints a line about the result. A reader that has gone away, like `head`, is not an error.
pub(super) fn say(line: impl Display) {
    let line = line.to_string();
    let line = escaped(&line);
    match LINES.load(Ordering::Relaxed) {
        lines if lines == LineTarget::Output as u8 => drop(writeln!(io::stdout(), "{line}")),
        lines if lines == LineTarget::Error as u8 => drop(writeln!(io::stderr(), "{line}")),
        _ => {}
    }
}

/// Prints warnings on standard error, one per line.
pub(super) fn warn(warnings: &[Warning]) {
    for Warning { message, .. } in warnings {
        warn_of(message);
    }
}

/// Prints a warning on standard error.
pub(super) fn warn_of(message: impl Display) {
    let _ = writeln!(io::stderr(), "warning: {}", escaped(&message.to_string()));
}

/// Prints requested output on standard output, regardless of the destination of lines.
pub(super) fn print(text: impl Display) {
    // The reader may have closed the pipe, as with `say`.
    let _ = writeln!(io::stdout(), "{}", escaped(&text.to_string()));
}

/// Prints a value as indented JSON on standard output.
pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), CommandFailure> {
    print(String::from_utf8_lossy(&json(value)?));
    Ok(())
}

/// Formats a value as indented JSON.
pub(super) fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, CommandFailure> {
    serde_json::to_vec_pretty(value).map_err(|error| CommandFailure::other(error.to_string()))
}

// Escaping of untrusted text for terminals.

/// Escapes characters that a terminal acts upon: control characters other than line breaks and tabs.
fn escaped(text: &str) -> Cow<'_, str> {
    if !text.contains(is_active) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_active(c) {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// Returns whether a terminal acts upon a character.
fn is_active(c: char) -> bool {
    c.is_control() && !matches!(c, '\n' | '\t')
}

/// Returns a name as one escaped line. File names may contain any character but one.
pub(super) fn one_line(name: &str) -> String {
    let name = name.replace('\n', "\\n").replace('\t', "\\t");
    escaped(&name).into_owned()
}

// Failures of commands: one line and an exit status.

/// Failure of a command: one line and an exit status.
#[derive(Debug)]
pub(super) struct CommandFailure {
    exit_code: u8,
    message: String,
}

impl CommandFailure {
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
    pub(super) fn about(mut self, what: impl Display) -> Self {
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
        let _ = writeln!(io::stderr(), "unwrapd: {message}");
        self.exit_code
    }
}

impl From<PipelineError> for CommandFailure {
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

impl CommandFailure {
    /// Converts the rejection of options, with option names as they are typed.
    pub(super) fn of_options(error: PipelineError) -> Self {
        let code = error.code();
        Self {
            message: format!("{} ({code})", typed(&error.to_string())),
            ..error.into()
        }
    }
}

impl From<RemoteError> for CommandFailure {
    fn from(error: RemoteError) -> Self {
        match error {
            RemoteError::Address { .. } | RemoteError::Key => Self::usage(error.to_string()),
            RemoteError::NoService { .. } => Self::other(error.to_string()),
        }
    }
}

impl From<ListError> for CommandFailure {
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
        $(impl From<$error> for CommandFailure {
            fn from(error: $error) -> Self {
                PipelineError::from(error).into()
            }
        })*
    };
}

input_errors!(ProblemError, WarpError, EditError);
