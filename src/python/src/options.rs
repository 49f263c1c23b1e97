//! Options, by the names and types of the command line and the service.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use unwrapd::deform::Model;
use unwrapd::options::{Object, OptionSet};
use unwrapd::pipeline::{MeasureOptions, Options, RepackOptions, SolveOptions, VerifyOptions};

use crate::error::invalid_options;

/// Returns the names of a function's options.
#[pyfunction]
pub fn option_names(function: &str) -> PyResult<Vec<&'static str>> {
    match function {
        "unwrap" => Ok(Options::names()),
        "repack" => Ok(RepackOptions::names()),
        "measure" => Ok(MeasureOptions::names()),
        "verify" => Ok(VerifyOptions::names()),
        "Problem" => Ok(Model::names()),
        "solve" => Ok(SolveOptions::names()),
        _ => Err(PyValueError::new_err(format!("no function {function:?}"))),
    }
}

/// Parses the options in a JSON object; the caller has checked their names.
pub fn parsed<O: OptionSet>(py: Python<'_>, json: &str) -> PyResult<O> {
    let object: Result<Object, _> = serde_json::from_str(json);
    (object.map_err(|error| error.to_string()))
        .and_then(|mut object| O::taken_from(&mut object))
        .map_err(|text| invalid_options(py, text))
}
