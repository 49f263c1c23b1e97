//! Folded meshes given as arrays: untangled.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::call::run;
use crate::files::{json, parsed};
use crate::meshes::rows;
use unwrapd::io::Elements;
use unwrapd::pipeline::{UntangleOptions, UntangledMesh, untangle_mesh};

/// Positions, elements wound alike, and the report as JSON.
type PyUntangled<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>, String);

/// Moves vertices of a mesh of triangles in the plane or of tetrahedra until no element is inverted or empty.
#[pyfunction]
pub fn untangle<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    elements: PyReadonlyArray2<'py, u32>,
    rest_vertices: Option<PyReadonlyArray2<'py, f64>>,
    options: &str,
) -> PyResult<PyUntangled<'py>> {
    let options: UntangleOptions = parsed(py, options)?;
    let width = elements.shape()[1];
    let given = rest_vertices
        .map(|places| mesh(&places, &elements))
        .transpose()?;
    let mesh = mesh(&vertices, &elements)?;
    // Untangle.
    let UntangledMesh {
        elements,
        dim,
        report,
    } = run(py, None, move |observer| {
        untangle_mesh(&mesh, given.as_ref(), &options, observer)
    })?;
    // Convert to arrays.
    let (n_vertices, n_elements) = (elements.vertices.len(), report.elements);
    let x: Vec<f64> = (elements.vertices.iter())
        .flat_map(|p| p[..dim].to_vec())
        .collect();
    let corners = if width == 3 {
        elements.triangles.into_flattened()
    } else {
        elements.tets.into_flattened()
    };
    Ok((
        PyArray1::from_vec(py, x).reshape([n_vertices, dim])?,
        PyArray1::from_vec(py, corners).reshape([n_elements, width])?,
        json(py, &report)?,
    ))
}

/// Returns the mesh of these positions, of the plane or of space, and of triangles or tetrahedra.
fn mesh(
    vertices: &PyReadonlyArray2<'_, f64>,
    elements: &PyReadonlyArray2<'_, u32>,
) -> PyResult<Elements> {
    let (dim, corners) = (vertices.shape()[1], elements.as_slice()?);
    let places = vertices.as_slice()?.chunks_exact(dim);
    let place = |p: &[f64]| std::array::from_fn(|k| p.get(k).copied().unwrap_or(0.0));
    let mut mesh = Elements {
        vertices: places.map(place).collect(),
        ..Elements::default()
    };
    if elements.shape()[1] == 3 {
        mesh.triangles = rows(corners);
    } else {
        mesh.tets = rows(corners);
    }
    Ok(mesh)
}
