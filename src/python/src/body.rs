//! Bodies from arrays.

use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use unwrapd::deform::{Body, ProblemError};
use unwrapd::mesh::{PlanarMesh, TetMesh};

use crate::arrays::rows;
use crate::error::refused;

/// Creates a body of triangles of the plane, of triangles of space laid flat one by one, or of tetrahedra, depending on
/// the shapes of the arrays. Triangles laid flat rest at `start`, their places in the plane.
pub fn body(
    py: Python<'_>,
    vertices: &PyReadonlyArray2<'_, f64>,
    elements: &PyReadonlyArray2<'_, u32>,
    start: Option<&[f64]>,
) -> PyResult<Body> {
    let (positions, corners) = (vertices.as_slice()?, elements.as_slice()?);
    let made = match (vertices.shape()[1], elements.shape()[1]) {
        (2, _) => PlanarMesh::new(rows(positions), rows(corners)).map(|mesh| Body::from(&mesh)),
        (_, 3) => Body::flattened(&rows(positions), &rows(corners)),
        _ => TetMesh::new(rows(positions), rows(corners)).map(|mesh| Body::from(&mesh)),
    };
    let mut body = made.map_err(|error| refused(py, ProblemError::from(error)))?;
    if let Some(start) = start {
        body.check(start).map_err(|error| refused(py, error))?;
        if vertices.shape()[1] > body.dim() {
            body.rest = start.to_vec();
        }
    }
    Ok(body)
}
