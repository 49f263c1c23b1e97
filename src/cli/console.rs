//! What a command says: lines about its result on standard output, or on standard error where that carries the result itself, and
//! warnings on standard error.

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU8, Ordering};

pub(super) use super::escaping::{escaped, one_line};
use super::failure::Failure;
use unwrapd_files::document::Warning;

/// Where lines about a result go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lines {
    /// To standard output.
    Output,
    /// To standard error: standard output carries the result.
    Error,
    /// Nowhere.
    None,
}

/// The streams are the process's, and so is what goes where.
static LINES: AtomicU8 = AtomicU8::new(Lines::Output as u8);

/// Says where lines go from now on.
pub(super) fn direct(lines: Lines) {
    LINES.store(lines as u8, Ordering::Relaxed);
}

/// Prints a line about the result. That a reader has gone away, as `head` does, is no failure.
pub(super) fn say(line: impl Display) {
    let line = line.to_string();
    let line = escaped(&line);
    match LINES.load(Ordering::Relaxed) {
        lines if lines == Lines::Output as u8 => drop(writeln!(io::stdout(), "{line}")),
        lines if lines == Lines::Error as u8 => drop(writeln!(io::stderr(), "{line}")),
        _ => {}
    }
}

/// Prints warnings on standard error, a line each.
pub(super) fn warn(warnings: &[Warning]) {
    for Warning { message, .. } in warnings {
        warn_of(message);
    }
}

/// Prints a warning on standard error.
pub(super) fn warn_of(message: impl Display) {
    let _ = writeln!(io::stderr(), "warning: {}", escaped(&message.to_string()));
}

/// Prints what was asked for on standard output, whatever lines about it do.
pub(super) fn print(text: impl Display) {
    // As with `say`, a reader may go away.
    let _ = writeln!(io::stdout(), "{}", escaped(&text.to_string()));
}

/// Prints a value as indented JSON on standard output.
pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print(String::from_utf8_lossy(&json(value)?));
    Ok(())
}

/// Indented JSON.
pub(super) fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, Failure> {
    serde_json::to_vec_pretty(value).map_err(|error| Failure::other(error.to_string()))
}
