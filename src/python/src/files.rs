//! Files as bytes, and options by the names and types of the command line and the service.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;

use crate::call::{internal, invalid_options, refused, run};
use crate::energy::{Functions, PyEnergy};
use unwrapd::deform::{Model, ProblemError};
use unwrapd::document::{Upload, with_references};
use unwrapd::options::{Object, OptionSet};
use unwrapd::pipeline::{
    self, CommandOptions, MeasureOptions, Observer, Options, Outcome, PipelineError, RepackOptions,
    SolveOptions, VerifyOptions,
};

/// A file with the files to which it refers: those passed with it, and those in a folder.
#[derive(FromPyObject)]
pub struct File<'py> {
    #[pyo3(item)]
    name: String,
    #[pyo3(item)]
    bytes: Bound<'py, PyBytes>,
    #[pyo3(item)]
    resources: BTreeMap<String, Vec<u8>>,
    #[pyo3(item)]
    folder: Option<PathBuf>,
}

impl File<'_> {
    fn upload(self) -> Upload {
        let upload = Upload {
            name: self.name,
            bytes: self.bytes.as_bytes().to_vec(),
            resources: self.resources,
        };
        match self.folder {
            Some(folder) => with_references(upload, |name| {
                // A pipe may never have a writer, and a device may never end.
                let path = folder.join(name);
                let is_regular = fs::metadata(&path).is_ok_and(|file| file.is_file());
                is_regular.then(|| fs::read(path).ok()).flatten()
            }),
            None => upload,
        }
    }
}

/// Returns the files to which a file refers, by the names that it uses for them; missing ones are left out.
#[pyfunction]
pub fn references<'py>(py: Python<'py>, file: File<'py>) -> Vec<(String, Bound<'py, PyBytes>)> {
    let resources = file.upload().resources.into_iter();
    resources
        .map(|(name, bytes)| (name, PyBytes::new(py, &bytes)))
        .collect()
}

/// Written files by name, the main one first, and the report.
type PyWritten<'py> = (Vec<(String, Bound<'py, PyBytes>)>, String);

/// Unwraps every mesh of a file.
#[pyfunction]
pub fn unwrap_document<'py>(
    py: Python<'py>,
    file: File<'py>,
    options: &str,
    functions: Option<Functions>,
    stem: Option<String>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<PyWritten<'py>> {
    let (options, energy) = unwrap_options(py, options, functions)?;
    let made = written(py, file, options, stem, progress, pipeline::unwrap_document);
    PyEnergy::outcome(energy.as_ref(), made)
}

/// Packs the UV islands of a file.
#[pyfunction]
pub fn repack_document<'py>(
    py: Python<'py>,
    file: File<'py>,
    options: &str,
    stem: Option<String>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<PyWritten<'py>> {
    let options: RepackOptions = parsed(py, options)?;
    written(py, file, options, stem, progress, pipeline::repack_document)
}

/// Measures the UVs of a file.
#[pyfunction]
pub fn measure_document(py: Python<'_>, file: File<'_>, options: &str) -> PyResult<String> {
    let (upload, options) = (file.upload(), parsed::<MeasureOptions>(py, options)?);
    let report = run(py, None, move |_| {
        pipeline::measure_document(&upload, &options)
    })?;
    json(py, &report)
}

/// Judges the UVs of a file.
#[pyfunction]
pub fn verify_document(py: Python<'_>, file: File<'_>, options: &str) -> PyResult<String> {
    let (upload, options) = (file.upload(), parsed::<VerifyOptions>(py, options)?);
    let verified = run(py, None, move |_| {
        pipeline::verify_document(&upload, &options)
    })?;
    json(py, &verified)
}

fn written<'py, O: CommandOptions + Send + 'static>(
    py: Python<'py>,
    file: File<'py>,
    mut options: O,
    stem: Option<String>,
    progress: Option<Bound<'py, PyAny>>,
    make: fn(&Upload, &O, &dyn Observer) -> Result<Outcome, PipelineError>,
) -> PyResult<PyWritten<'py>> {
    let upload = file.upload();
    options.caller_mut().stem = stem;
    let outcome = run(py, progress.as_ref(), move |observer| {
        make(&upload, &options, observer)
    })?;
    let files = outcome.files.into_iter();
    let files = files.map(|(name, bytes)| (name, PyBytes::new(py, &bytes)));
    Ok((files.collect(), json(py, &outcome.report)?))
}

/// Returns a report as JSON.
pub fn json<T: Serialize>(py: Python<'_>, report: &T) -> PyResult<String> {
    serde_json::to_string(report).map_err(|error| internal(py, &error.to_string()))
}

// Options, by the names and types of the command line and the service.

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

/// Returns the options of unwrapping, and the functions of their energy if it consists of functions.
pub fn unwrap_options(
    py: Python<'_>,
    options: &str,
    functions: Option<Functions>,
) -> PyResult<(Options, Option<Arc<PyEnergy>>)> {
    let mut options: Options = parsed(py, options)?;
    let energy = functions.map(PyEnergy::new);
    if let Some(energy) = &energy {
        let density = energy.density(2)?;
        options.mapping.energy = density.map_err(|error| refused(py, ProblemError::from(error)))?;
    }
    Ok((options, energy))
}

/// Parses the options in a JSON object; the caller has checked their names.
pub fn parsed<O: OptionSet>(py: Python<'_>, json: &str) -> PyResult<O> {
    let object: Result<Object, _> = serde_json::from_str(json);
    (object.map_err(|error| error.to_string()))
        .and_then(|mut object| O::taken_from(&mut object))
        .map_err(|text| invalid_options(py, text))
}
