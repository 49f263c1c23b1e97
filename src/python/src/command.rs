//! The command `unwrapd`, as Python starts it.

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use pyo3::prelude::*;
use unwrapd::cli;
use unwrapd::jobs::Program;

/// Runs a command line and returns its exit code. Children of the command are started as `python launcher…`; `engine`
/// is this extension.
#[pyfunction]
pub fn run_command(
    py: Python<'_>,
    arguments: Vec<OsString>,
    python: PathBuf,
    launcher: Vec<OsString>,
    engine: PathBuf,
) -> u8 {
    let program = Program {
        file: python,
        arguments: launcher,
        engine,
    };
    py.detach(|| {
        let code = cli::run(arguments, Ok(program));
        // Python does not flush Rust's buffer at the end of the process. A reader may have closed the pipe.
        let _ = std::io::stdout().flush();
        code
    })
}
