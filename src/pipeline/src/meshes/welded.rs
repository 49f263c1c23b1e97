//! Conversion of corner UVs to vertex UVs.

use std::collections::HashMap;

use unwrapd_maps::mesh::CornerUvs;

/// A mesh in which every vertex has one UV: each given vertex appears once per distinct UV of its corners, in the
/// order of first use. Vertices without triangles are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WeldedUvs {
    /// Index of each vertex in the given mesh.
    pub origins: Vec<u32>,
    /// Vertices of the triangles, in the same number, order and rotation as the given ones.
    pub triangles: Vec<[u32; 3]>,
    /// UVs of the vertices.
    pub uvs: Vec<[f64; 2]>,
}

impl WeldedUvs {
    /// Welds triangles with UVs of their corners.
    pub fn new(triangles: &[[u32; 3]], uvs: &[CornerUvs]) -> Self {
        let mut welded = Self::default();
        let mut known: HashMap<(u32, [u64; 2]), u32> = HashMap::with_capacity(triangles.len());
        for (triangle, corners) in triangles.iter().zip(uvs) {
            let face = [0, 1, 2].map(|c| {
                let (vertex, uv) = (triangle[c], corners[c]);
                *known
                    .entry((vertex, uv.map(f64::to_bits)))
                    .or_insert_with(|| {
                        welded.origins.push(vertex);
                        welded.uvs.push(uv);
                        welded.uvs.len() as u32 - 1
                    })
            });
            welded.triangles.push(face);
        }
        welded
    }
}
