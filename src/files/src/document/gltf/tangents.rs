//! Tangents of a UV map, as MikkTSpace defines them.
use super::document::GltfDocument;
use crate::document::{CornerTangents, DocumentError, Primitive};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};

/// Returns the tangents of every corner for UVs with v up; `None` if the primitive has no usable normals.
pub(super) fn corner_tangents(
    document: &GltfDocument,
    index: usize,
    uvs: &[[[f32; 2]; 3]],
) -> Result<Option<Vec<CornerTangents>>, DocumentError> {
    let Some(normals) = document.corner_normals(index)? else {
        return Ok(None);
    };
    let normals = normals.iter().map(|face| face.map(|n| n.map(|x| x as f32)));
    let normals: Vec<[[f32; 3]; 3]> = normals.collect();
    let is_usable = normals
        .as_flattened()
        .as_flattened()
        .iter()
        .all(|x| x.is_finite());
    Ok(is_usable
        .then(|| tangents(&document.primitives[index], &normals, uvs))
        .flatten())
}

/// Returns the tangents of every corner of a primitive for normals and UVs with v up, as MikkTSpace defines them.
pub fn tangents(
    primitive: &Primitive,
    normals: &[[[f32; 3]; 3]],
    uvs: &[[[f32; 2]; 3]],
) -> Option<Vec<CornerTangents>> {
    let tangents = vec![[[1.0, 0.0, 0.0, 1.0]; 3]; uvs.len()];
    let mut shape = TangentShape {
        primitive,
        normals,
        uvs,
        tangents,
    };
    // The error type has no values yet; should it get one, there are no tangents.
    generate_tangents(&mut shape).ok().map(|()| shape.tangents)
}

struct TangentShape<'a> {
    primitive: &'a Primitive,
    normals: &'a [[[f32; 3]; 3]],
    uvs: &'a [[[f32; 2]; 3]],
    tangents: Vec<CornerTangents>,
}

impl Geometry for TangentShape<'_> {
    fn num_faces(&self) -> usize {
        self.uvs.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.primitive.triangles[face][corner] as usize]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals[face][corner]
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[face][corner]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(tangent) = space.map(|space| space.tangent_encoded()) else {
            return;
        };
        let length = tangent[..3].iter().map(|x| x * x).sum::<f32>();
        // Degenerate neighborhoods give no direction; the default is at least a unit vector.
        if (length - 1.0).abs() < 1e-3 {
            self.tangents[face][corner] = tangent;
        }
    }
}
