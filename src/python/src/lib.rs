//! The native part of the Python package `unwrapd`: arrays, bytes and JSON in and out of the library.
//!
//! The public interface is written in Python, next to this crate; it passes arrays of the types named here, and options
//! as JSON objects like those of the service. Every call computes on threads of its own with the interpreter released,
//! and checks every 20 ms for Ctrl-C.

#![allow(
    clippy::needless_pass_by_value,
    reason = "what Python hands over belongs to the call"
)]

mod call;
mod energy;
mod files;
mod meshes;
mod problem;
mod session;
mod untangle;

#[cfg(unix)]
use std::ffi::OsString;
#[cfg(unix)]
use std::path::PathBuf;

use pyo3::prelude::*;

/// The native part of the Python package `unwrapd`; see `unwrapd/_native.pyi`.
#[pymodule(name = "_native")]
mod unwrapd_native {
    #[pymodule_export]
    use super::call::PyProgress;
    #[pymodule_export]
    use super::call::Shown;
    #[pymodule_export]
    use super::files::option_names;
    #[pymodule_export]
    use super::files::{
        measure_document, references, repack_document, unwrap_document, verify_document,
    };
    #[pymodule_export]
    use super::meshes::bake;
    #[pymodule_export]
    use super::meshes::{measure, repack, unwrap, verify};
    #[pymodule_export]
    use super::problem::PyProblem;
    #[cfg(unix)]
    #[pymodule_export]
    use super::run_command;
    #[pymodule_export]
    use super::session::PySession;
    #[pymodule_export]
    use super::untangle::untangle;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

/// Runs a command line and returns its exit code. Children of the command are started as `python launcher…`; `engine`
/// is this extension.
#[cfg(unix)]
#[pyfunction]
pub fn run_command(
    py: Python<'_>,
    arguments: Vec<OsString>,
    python: PathBuf,
    launcher: Vec<OsString>,
    engine: PathBuf,
) -> u8 {
    let program = unwrapd::jobs::Program {
        file: python,
        arguments: launcher,
        engine,
    };
    py.detach(|| {
        let code = unwrapd::cli::run(arguments, Ok(program));
        // Python does not flush Rust's buffer at the end of the process. A reader may have closed the pipe.
        let _ = std::io::Write::flush(&mut std::io::stdout());
        code
    })
}
