//! Output of commands: lines about the result on standard output, or on standard error if standard output carries the
//! result itself, and warnings on standard error.

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU8, Ordering};

pub(super) use super::escaping::{escaped, one_line};
use super::failure::Failure;
use unwrapd_files::document::Warning;

/// Destination of lines about a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lines {
    /// Standard output.
    Output,
    /// Standard error, because standard output carries the result.
    Error,
    /// Nowhere.
    None,
}

/// Destination of lines, which is global like the streams.
static LINES: AtomicU8 = AtomicU8::new(Lines::Output as u8);

/// Sets the destination of lines.
pub(super) fn direct(lines: Lines) {
    LINES.store(lines as u8, Ordering::Relaxed);
}

/// Prints a line about the result. A reader that has gone away, like `head`, is not an error.
pub(super) fn say(line: impl Display) {
    let line = line.to_string();
    let line = escaped(&line);
    match LINES.load(Ordering::Relaxed) {
        lines if lines == Lines::Output as u8 => drop(writeln!(io::stdout(), "{line}")),
        lines if lines == Lines::Error as u8 => drop(writeln!(io::stderr(), "{line}")),
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
pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print(String::from_utf8_lossy(&json(value)?));
    Ok(())
}

/// Formats a value as indented JSON.
pub(super) fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, Failure> {
    serde_json::to_vec_pretty(value).map_err(|error| Failure::other(error.to_string()))
}
