//! Errors of the library as exceptions of the package.

use pyo3::prelude::*;
use unwrapd::deform::ProblemError;
use unwrapd::pipeline::PipelineError;

/// Returns the exception for an error of the library, with its code.
pub fn exception(py: Python<'_>, error: &PipelineError) -> PyErr {
    let column = error.column();
    of(
        py,
        error.code(),
        error.exit_code(),
        &error.to_string(),
        column,
    )
}

/// Returns the exception for a problem that cannot be solved.
pub fn refused(py: Python<'_>, error: impl Into<ProblemError>) -> PyErr {
    exception(py, &PipelineError::from(error.into()))
}

/// Returns the exception for invalid options.
pub fn invalid_options(py: Python<'_>, text: String) -> PyErr {
    exception(py, &PipelineError::InvalidOptions(text))
}

/// Returns the exception for a bug of this program.
pub fn internal(py: Python<'_>, text: &str) -> PyErr {
    of(py, "internal_error", 1, text, None)
}

fn of(py: Python<'_>, code: &str, exit_code: u8, message: &str, column: Option<usize>) -> PyErr {
    let made = py
        .import("unwrapd._errors")
        .and_then(|module| module.call_method1("of", (code, exit_code, message, column)));
    made.map_or_else(|error| error, PyErr::from_value)
}
