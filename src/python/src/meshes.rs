//! Meshes given as arrays: unwrapped, packed, measured, judged, and attributes baked into textures.

use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::call::run;
use crate::energy::{Functions, PyEnergy};
use crate::files::{json, parsed, unwrap_options};
use unwrapd::bake::{Corners, Coverage, MOST_TEXELS, baked_attribute};
use unwrapd::pipeline::{
    self, MeasureOptions, MeshArrays, Observer, PipelineError, RepackOptions, UnwrappedMeshes,
    VerifyOptions, WeldedUvs, Workers, in_pool,
};

/// Meshes that share an atlas, and the report.
type PyAtlas<'py> = (Vec<PyWelded<'py>>, String);

/// Unwraps meshes into one atlas.
#[pyfunction]
pub fn unwrap<'py>(
    py: Python<'py>,
    meshes: Vec<Mesh<'py>>,
    options: &str,
    functions: Option<Functions>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<PyAtlas<'py>> {
    let (options, energy) = unwrap_options(py, options, functions)?;
    let made = atlas(py, &meshes, options, progress, pipeline::unwrap_meshes);
    PyEnergy::outcome(energy.as_ref(), made)
}

/// Packs the UV islands of meshes into one atlas.
#[pyfunction]
pub fn repack<'py>(
    py: Python<'py>,
    meshes: Vec<Mesh<'py>>,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<PyAtlas<'py>> {
    let options: RepackOptions = parsed(py, options)?;
    atlas(py, &meshes, options, progress, pipeline::repack_meshes)
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

fn atlas<'py, O: Send + 'static>(
    py: Python<'py>,
    meshes: &[Mesh<'py>],
    options: O,
    progress: Option<Bound<'py, PyAny>>,
    make: fn(&[MeshArrays], &O, &dyn Observer) -> Result<UnwrappedMeshes, PipelineError>,
) -> PyResult<PyAtlas<'py>> {
    let meshes = taken(meshes)?;
    let (meshes, unwrapped) = run(py, progress.as_ref(), move |observer| {
        let unwrapped = make(&meshes, &options, observer)?;
        Ok((meshes, unwrapped))
    })?;
    let report = json(py, &unwrapped.report)?;
    Ok((given(py, &meshes, unwrapped)?, report))
}

// Arrays of NumPy in and out.

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
pub type PyWelded<'py> = (
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
) -> PyResult<Vec<PyWelded<'py>>> {
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

// Vertex attributes baked into textures.

/// Image (size, size, C) and mask of the charts (size, size); the first row is at v = 1.
type PyBaked<'py> = (Bound<'py, PyArray3<f32>>, Bound<'py, PyArray2<bool>>);

/// Interpolates values (F, 3, C) of corners, whose UVs (F, 3, 2) have v up.
#[pyfunction]
pub fn bake<'py>(
    py: Python<'py>,
    uvs: PyReadonlyArray3<'py, f64>,
    values: PyReadonlyArray3<'py, f32>,
    size: usize,
    threads: Option<usize>,
) -> PyResult<PyBaked<'py>> {
    let n_channels = values.shape()[2];
    // Refuse sizes and UVs that cannot be baked.
    let texels = (size as u64).checked_mul(size as u64);
    if size == 0 || texels.is_none_or(|texels| texels > MOST_TEXELS) {
        return Err(PyValueError::new_err(format!(
            "size must lie between 1 and {}, not {size}",
            MOST_TEXELS.isqrt()
        )));
    }
    let faces: Vec<Corners> = corners(&uvs)?
        .into_iter()
        .map(|face: Corners| face.map(|[u, v]| [u, 1.0 - v]))
        .collect();
    if faces
        .as_flattened()
        .as_flattened()
        .iter()
        .any(|x| !x.is_finite())
    {
        return Err(PyValueError::new_err("uvs must be finite"));
    }
    // Bake one channel after another, each into its places of the image.
    let values = values.as_slice()?.to_vec();
    let (image, mask) = run(py, None, move |_| {
        in_pool(Workers { threads }, || {
            let coverage = Coverage::new(&faces, size);
            let mut image = vec![0.0; size * size * n_channels];
            for channel in 0..n_channels {
                let corners: Vec<[f32; 3]> = (0..faces.len())
                    .map(|face| [0, 1, 2].map(|c| values[(3 * face + c) * n_channels + channel]))
                    .collect();
                let texels = baked_attribute(&coverage, &corners);
                let own = image.iter_mut().skip(channel).step_by(n_channels);
                own.zip(texels).for_each(|(own, texel)| *own = texel);
            }
            let texels = 0..size * size;
            let mask = texels.map(|texel| coverage.is_inside(texel % size, texel / size));
            (image, mask.collect::<Vec<bool>>())
        })
    })?;
    Ok((
        PyArray1::from_vec(py, image).reshape([size, size, n_channels])?,
        PyArray1::from_vec(py, mask).reshape([size, size])?,
    ))
}
