//! Meshes given as arrays.

use pyo3::prelude::*;
use unwrapd::options::OptionSet;
use unwrapd::pipeline::{
    self, MeasureOptions, MeshArrays, Observer, Options, PipelineError, RepackOptions,
    UnwrappedMeshes, VerifyOptions,
};

use crate::arrays::{Mesh, Welded, given, taken};
use crate::call::run;
use crate::files::json;
use crate::options::parsed;

/// Meshes that share an atlas, and the report.
type Atlas<'py> = (Vec<Welded<'py>>, String);

/// Unwraps meshes into one atlas.
#[pyfunction]
pub fn unwrap<'py>(
    py: Python<'py>,
    meshes: Vec<Mesh<'py>>,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Atlas<'py>> {
    atlas::<Options>(py, &meshes, options, progress, pipeline::unwrap_meshes)
}

/// Packs the UV islands of meshes into one atlas.
#[pyfunction]
pub fn repack<'py>(
    py: Python<'py>,
    meshes: Vec<Mesh<'py>>,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Atlas<'py>> {
    atlas::<RepackOptions>(py, &meshes, options, progress, pipeline::repack_meshes)
}

/// Measures UVs.
#[pyfunction]
pub fn measure(py: Python<'_>, meshes: Vec<Mesh<'_>>, options: &str) -> PyResult<String> {
    let (meshes, options) = (taken(&meshes)?, parsed::<MeasureOptions>(py, options)?);
    let report = run(py, None, move |_| {
        pipeline::measure_meshes(&meshes, &options)
    })?;
    json(py, &report)
}

/// Judges UVs.
#[pyfunction]
pub fn verify(py: Python<'_>, meshes: Vec<Mesh<'_>>, options: &str) -> PyResult<String> {
    let (meshes, options) = (taken(&meshes)?, parsed::<VerifyOptions>(py, options)?);
    let verified = run(py, None, move |_| {
        pipeline::verify_meshes(&meshes, &options)
    })?;
    json(py, &verified)
}

fn atlas<'py, O: OptionSet + Send + 'static>(
    py: Python<'py>,
    meshes: &[Mesh<'py>],
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
    make: fn(&[MeshArrays], &O, &dyn Observer) -> Result<UnwrappedMeshes, PipelineError>,
) -> PyResult<Atlas<'py>> {
    let (meshes, options) = (taken(meshes)?, parsed::<O>(py, options)?);
    let (meshes, unwrapped) = run(py, progress.as_ref(), move |observer| {
        let unwrapped = make(&meshes, &options, observer)?;
        Ok((meshes, unwrapped))
    })?;
    let report = json(py, &unwrapped.report)?;
    Ok((given(py, &meshes, unwrapped)?, report))
}
