//! Vertex attributes baked into textures.

use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use unwrapd::bake::{Corners, Coverage, MOST_TEXELS, baked_attribute};
use unwrapd::pipeline::{Workers, in_pool};

use crate::arrays::corners;
use crate::call::run;

/// Image (size, size, C) and mask of the charts (size, size); the first row is at v = 1.
type Baked<'py> = (Bound<'py, PyArray3<f32>>, Bound<'py, PyArray2<bool>>);

/// Interpolates values (F, 3, C) of corners, whose UVs (F, 3, 2) have v up.
#[pyfunction]
pub fn bake<'py>(
    py: Python<'py>,
    uvs: PyReadonlyArray3<'py, f64>,
    values: PyReadonlyArray3<'py, f32>,
    size: usize,
    threads: Option<usize>,
) -> PyResult<Baked<'py>> {
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
                let value = |corner: usize| values[corner * n_channels + channel];
                let corners = (0..faces.len()).map(|face| [0, 1, 2].map(|c| value(3 * face + c)));
                let corners: Vec<[f32; 3]> = corners.collect();
                let texels = baked_attribute(&coverage, &corners);
                let own = image.iter_mut().skip(channel).step_by(n_channels);
                own.zip(texels).for_each(|(own, texel)| *own = texel);
            }
            let inside = |texel: usize| coverage.is_inside(texel % size, texel / size);
            (image, (0..size * size).map(inside).collect::<Vec<bool>>())
        })
    })?;
    Ok((
        PyArray1::from_vec(py, image).reshape([size, size, n_channels])?,
        PyArray1::from_vec(py, mask).reshape([size, size])?,
    ))
}
