//! Arrays of NumPy in and out.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use unwrapd::pipeline::{MeshArrays, UnwrappedMeshes, WeldedUvs};

/// A mesh from Python: positions (V, 3), faces (F, 3) and, for each corner of each face, UVs (F, 3, 2) and normals
/// (F, 3, 3). All arrays are contiguous.
#[derive(FromPyObject)]
pub struct Mesh<'py>(
    Bound<'py, PyAny>,
    PyReadonlyArray2<'py, u32>,
    Option<PyReadonlyArray3<'py, f64>>,
    Option<PyReadonlyArray3<'py, f64>>,
);

/// A mesh for Python: the vertex of the given mesh for each vertex, faces, UVs (v up), and the chart of each face.
pub type Welded<'py> = (
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray1<u32>>,
);

/// Converts meshes to the library's types.
pub fn taken(meshes: &[Mesh<'_>]) -> PyResult<Vec<MeshArrays>> {
    meshes.iter().map(mesh).collect()
}

fn mesh(Mesh(positions, faces, uvs, normals): &Mesh<'_>) -> PyResult<MeshArrays> {
    Ok(MeshArrays {
        positions: positions_of(positions)?,
        triangles: rows(faces.as_slice()?),
        uvs: uvs.as_ref().map(corners).transpose()?,
        normals: normals.as_ref().map(corners).transpose()?,
    })
}

/// Returns positions of either precision; the Python code refuses all other types.
fn positions_of(positions: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 3]>> {
    if let Ok(positions) = positions.extract::<PyReadonlyArray2<f32>>() {
        let rows: Vec<[f32; 3]> = rows(positions.as_slice()?);
        return Ok(rows.into_iter().map(|p| p.map(f64::from)).collect());
    }
    match positions.extract::<PyReadonlyArray2<f64>>() {
        Ok(positions) => Ok(rows(positions.as_slice()?)),
        Err(_) => Err(PyTypeError::new_err("positions must be float32 or float64")),
    }
}

/// Returns N numbers for each corner of each face.
pub fn corners<T: Copy + numpy::Element, const N: usize>(
    array: &PyReadonlyArray3<'_, T>,
) -> PyResult<Vec<[[T; N]; 3]>> {
    let rows: Vec<[T; N]> = rows(array.as_slice()?);
    Ok(self::rows(&rows))
}

/// Splits an array into rows of N numbers each.
pub fn rows<T: Copy, const N: usize>(flat: &[T]) -> Vec<[T; N]> {
    flat.as_chunks::<N>().0.to_vec()
}

/// Converts unwrapped meshes to arrays.
pub fn given<'py>(
    py: Python<'py>,
    meshes: &[MeshArrays],
    unwrapped: UnwrappedMeshes,
) -> PyResult<Vec<Welded<'py>>> {
    let all = meshes.iter().zip(unwrapped.uvs).zip(unwrapped.charts);
    all.map(|((mesh, uvs), charts)| {
        let WeldedUvs {
            origins,
            triangles,
            uvs,
        } = WeldedUvs::new(&mesh.triangles, &uvs);
        let uvs: Vec<[f32; 2]> = uvs.into_iter().map(|uv| uv.map(|x| x as f32)).collect();
        Ok((
            PyArray1::from_vec(py, origins),
            table(py, triangles)?,
            table(py, uvs)?,
            PyArray1::from_vec(py, charts),
        ))
    })
    .collect()
}

fn table<T: numpy::Element, const N: usize>(
    py: Python<'_>,
    rows: Vec<[T; N]>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let n_rows = rows.len();
    PyArray1::from_vec(py, rows.into_flattened()).reshape([n_rows, N])
}
