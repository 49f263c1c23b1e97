//! Tangents for a replaced UV set, as MikkTSpace defines them.
use super::GltfDocument;
use super::accessor::Accessor;
use super::json::unsigned;
use crate::document::{DocumentError, Primitive};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};

/// Tangent and sign of the three corners of a face.
pub(super) type CornerTangents = [[f32; 4]; 3];

/// The tangents of every corner for UVs with v up; `None` where the primitive has no usable normals.
pub(super) fn corner_tangents(
    document: &GltfDocument,
    index: usize,
    uvs: &[[[f32; 2]; 3]],
) -> Result<Option<Vec<CornerTangents>>, DocumentError> {
    let primitive = &document.primitives[index];
    let attributes = &document.object(primitive)?["attributes"];
    let Some(normal) = unsigned(attributes, "NORMAL")? else {
        return Ok(None);
    };
    let accessor = Accessor::open(&document.body, normal)?;
    if !accessor.is("VEC3") {
        return Ok(None);
    }
    let mut normals: Vec<[f32; 3]> = accessor.vectors()?;
    if let Some(used) = &document.used[index] {
        normals = used
            .iter()
            .map(|vertex| normals[*vertex as usize])
            .collect();
    }
    if !normals.iter().flatten().all(|x| x.is_finite()) {
        return Ok(None);
    }
    let tangents = vec![[[1.0, 0.0, 0.0, 1.0]; 3]; uvs.len()];
    let mut shape = Shape {
        primitive,
        normals,
        uvs,
        tangents,
    };
    // The error type has no values yet; should it get one, there are no tangents.
    Ok(generate_tangents(&mut shape).ok().map(|()| shape.tangents))
}

struct Shape<'a> {
    primitive: &'a Primitive,
    normals: Vec<[f32; 3]>,
    uvs: &'a [[[f32; 2]; 3]],
    tangents: Vec<CornerTangents>,
}

impl Shape<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.primitive.triangles[face][corner] as usize
    }
}

impl Geometry for Shape<'_> {
    fn num_faces(&self) -> usize {
        self.uvs.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.vertex(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals[self.vertex(face, corner)]
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[face][corner]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(tangent) = space.map(|space| space.tangent_encoded()) else {
            return;
        };
        let length = tangent[..3].iter().map(|x| x * x).sum::<f32>();
        // Degenerate neighbourhoods give no direction; the default is at least a unit vector.
        if (length - 1.0).abs() < 1e-3 {
            self.tangents[face][corner] = tangent;
        }
    }
}
