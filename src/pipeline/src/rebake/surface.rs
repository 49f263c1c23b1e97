//! Primitives with their new UVs.

use unwrapd_files::document::gltf::{GltfDocument, tangents};
use unwrapd_files::document::{CornerTangents, DocumentError, NewUvs};
use unwrapd_maps::mesh::VAxis;

/// A primitive with its new UVs.
pub(super) struct Surface {
    /// New UVs, v down.
    pub uvs: Vec<[[f64; 2]; 3]>,
    pub directions: Option<Directions>,
}

/// Reference frames of normal maps.
pub(super) struct Directions {
    pub normals: Vec<[[f32; 3]; 3]>,
    pub tangents: Vec<CornerTangents>,
    /// Set if the document has these normals. Otherwise they are those of the flat faces, and tangents are not
    /// written.
    are_given: bool,
}

impl Surface {
    pub fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &NewUvs,
        is_normal_mapped: bool,
    ) -> Result<Self, DocumentError> {
        let upward = uvs.toward(index, VAxis::Up).unwrap_or_default();
        let downward = |[u, v]: [f32; 2]| [f64::from(u), 1.0 - f64::from(v)];
        let directions = if is_normal_mapped {
            Some(Directions::new(document, index, &upward)?)
        } else {
            None
        };
        Ok(Self {
            uvs: upward.iter().map(|face| face.map(downward)).collect(),
            directions,
        })
    }

    /// Returns the tangents to write to the document.
    pub fn written_tangents(self) -> Option<Vec<CornerTangents>> {
        let directions = self.directions.filter(|directions| directions.are_given);
        directions.map(|directions| directions.tangents)
    }
}

impl Directions {
    fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &[[[f32; 2]; 3]],
    ) -> Result<Self, DocumentError> {
        let primitive = &document.primitives()[index];
        let single = |face: [[f64; 3]; 3]| face.map(|n| n.map(|x| x as f32));
        let given = document.corner_normals(index)?;
        let are_given = given.is_some();
        let normals: Vec<_> = match given {
            Some(normals) => normals.into_iter().map(single).collect(),
            None => (primitive.triangles.iter())
                .map(|face| [flat_normal(face.map(|v| primitive.positions[v as usize])); 3])
                .collect(),
        };
        let tangents = tangents(primitive, &normals, uvs);
        Ok(Self {
            tangents: tangents.unwrap_or_else(|| vec![[[1.0, 0.0, 0.0, 1.0]; 3]; uvs.len()]),
            normals,
            are_given,
        })
    }
}

/// Returns the unit normal of a flat face; zero if the face is degenerate.
fn flat_normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let (e, f) = (
        [0, 1, 2].map(|k| b[k] - a[k]),
        [0, 1, 2].map(|k| c[k] - a[k]),
    );
    let normal = [
        e[1] * f[2] - e[2] * f[1],
        e[2] * f[0] - e[0] * f[2],
        e[0] * f[1] - e[1] * f[0],
    ];
    let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
    normal.map(|x| x / length.max(f32::MIN_POSITIVE))
}
