//! The native part of the Python package `unwrapd`: arrays, bytes and JSON in and out of the library.
//!
//! The public interface is written in Python, next to this crate; it passes arrays of the types named here, and options
//! as JSON objects like those of the service. Every call computes on threads of its own with the interpreter released,
//! and checks every 20 ms for Ctrl-C.

#![allow(
    clippy::needless_pass_by_value,
    reason = "what Python hands over belongs to the call"
)]

mod arrays;
mod bake;
mod body;
mod call;
#[cfg(unix)]
mod command;
mod error;
mod files;
mod iterates;
mod meshes;
mod options;
mod pool;
mod problem;
mod session;

use pyo3::prelude::*;

/// The native part of the Python package `unwrapd`; see `unwrapd/_native.pyi`.
#[pymodule(name = "_native")]
mod unwrapd_native {
    #[pymodule_export]
    use super::bake::bake;
    #[pymodule_export]
    use super::call::Progress;
    #[cfg(unix)]
    #[pymodule_export]
    use super::command::run_command;
    #[pymodule_export]
    use super::files::{
        measure_document, references, repack_document, unwrap_document, verify_document,
    };
    #[pymodule_export]
    use super::iterates::Shown;
    #[pymodule_export]
    use super::meshes::{measure, repack, unwrap, verify};
    #[pymodule_export]
    use super::options::option_names;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::session::Session;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
