//! Meshes given as arrays, unwrapped on the calling thread.

use napi::bindgen_prelude::{Either, Float32Array, Uint32Array};
use napi_derive::napi;
use serde::de::DeserializeOwned;
use unwrapd::pipeline::{
    self, MeshArrays, Observer, Options, PipelineError, RepackOptions, UnwrappedMeshes, WeldedUvs,
};

use crate::call::{Cancellation, Failure, run};
use crate::options::{json, parsed};

/// A mesh: positions, UVs and normals of the vertices, and the vertices of the triangles.
#[napi(object, object_to_js = false)]
pub struct Mesh {
    /// Three coordinates for each vertex.
    pub positions: Float32Array,
    /// Three vertices for each triangle.
    pub indices: Uint32Array,
    /// Two coordinates for each vertex, v up.
    pub uvs: Option<Float32Array>,
    /// Three coordinates for each vertex.
    pub normals: Option<Float32Array>,
}

impl Mesh {
    fn taken(&self) -> Result<MeshArrays, Failure> {
        let triangles = self.indices.as_chunks::<3>().0.to_vec();
        Ok(MeshArrays {
            positions: rows(&self.positions),
            uvs: (self.uvs.as_deref())
                .map(|uvs| corners(&triangles, &rows(uvs)))
                .transpose()?,
            normals: (self.normals.as_deref())
                .map(|normals| corners(&triangles, &rows(normals)))
                .transpose()?,
            triangles,
        })
    }
}

/// Splits a flat array into rows of N numbers.
fn rows<const N: usize>(flat: &[f32]) -> Vec<[f64; N]> {
    let rows = flat.as_chunks::<N>().0.iter();
    rows.map(|row| row.map(f64::from)).collect()
}

/// Returns the values of the corners of triangles from those of the vertices.
fn corners<const N: usize>(
    triangles: &[[u32; 3]],
    of_vertices: &[[f64; N]],
) -> Result<Vec<[[f64; N]; 3]>, Failure> {
    let mut corners = Vec::with_capacity(triangles.len());
    for triangle in triangles {
        let [Some(&a), Some(&b), Some(&c)] = triangle.map(|v| of_vertices.get(v as usize)) else {
            return Err(Failure::internal("a vertex has no UV or normal"));
        };
        corners.push([a, b, c]);
    }
    Ok(corners)
}

/// A mesh in which every vertex has one UV.
#[napi(object, object_from_js = false)]
pub struct Welded {
    /// Vertex of the given mesh for each vertex.
    pub origins: Uint32Array,
    /// Three vertices for each triangle, in the given order.
    pub indices: Uint32Array,
    /// Two coordinates for each vertex, v up.
    pub uvs: Float32Array,
    /// Chart of each triangle, counted over all meshes.
    pub charts: Uint32Array,
}

/// Meshes that share an atlas.
#[napi(object, object_from_js = false)]
pub struct Atlas {
    /// In the given order.
    pub meshes: Vec<Welded>,
    /// The report as JSON.
    pub report: String,
}

/// Unwraps meshes into one atlas.
#[napi]
pub fn unwrap_meshes(meshes: Vec<Mesh>, options: String) -> Either<Atlas, Failure> {
    let made = made::<Options>(&meshes, &options, pipeline::unwrap_meshes);
    made.map_or_else(Either::B, Either::A)
}

/// Packs the UV islands of meshes into one atlas.
#[napi]
pub fn repack_meshes(meshes: Vec<Mesh>, options: String) -> Either<Atlas, Failure> {
    let made = made::<RepackOptions>(&meshes, &options, pipeline::repack_meshes);
    made.map_or_else(Either::B, Either::A)
}

fn made<O: DeserializeOwned>(
    meshes: &[Mesh],
    options: &str,
    make: fn(&[MeshArrays], &O, &dyn Observer) -> Result<UnwrappedMeshes, PipelineError>,
) -> Result<Atlas, Failure> {
    // Unwrap or repack the meshes.
    let meshes = (meshes.iter().map(Mesh::taken)).collect::<Result<Vec<_>, _>>()?;
    let options = parsed::<O>(options)?;
    let unwrapped = run(Cancellation::default(), |observer| {
        make(&meshes, &options, observer)
    })?;
    // Weld corners with equal vertices and UVs.
    let all = meshes.iter().zip(unwrapped.uvs).zip(unwrapped.charts);
    let welded = all.map(|((mesh, uvs), charts)| {
        let welded = WeldedUvs::new(&mesh.triangles, &uvs);
        let uvs: Vec<f32> = (welded.uvs.as_flattened().iter())
            .map(|x| *x as f32)
            .collect();
        Welded {
            origins: welded.origins.into(),
            indices: welded.triangles.into_flattened().into(),
            uvs: uvs.into(),
            charts: charts.into(),
        }
    });
    Ok(Atlas {
        meshes: welded.collect(),
        report: json(&unwrapped.report)?,
    })
}
