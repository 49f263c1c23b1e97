//! A new OBJ file for triangles that came from another format.
use super::texcoord_lines::{TexcoordLines, decimal};
use super::{
    DocumentError, NewUvs, Primitive, PrimitiveNote, TangentsNote, Warning, WriteNotes,
    WriteOptions, Written,
};
use crate::measure::VAxis;
use std::io::Write as _;

/// Writes all primitives, each as a group of its mesh's object, with the names that groups have in reports. Materials
/// are named by their number; there is no material file, and transforms of nodes are not applied.
pub(super) fn write(
    primitives: &[Primitive],
    uvs: &NewUvs,
    options: &WriteOptions,
) -> Result<Written, DocumentError> {
    only_set(options)?;
    let mut text = Vec::new();
    let mut lines = TexcoordLines::default();
    let mut faces = Vec::new();
    let mut notes = WriteNotes::default();
    let mut first_vertex = 1;
    let mut mesh = None;
    for (index, primitive) in primitives.iter().enumerate() {
        let corners = uvs.toward(index, VAxis::Up);
        for position in &primitive.positions {
            let [x, y, z] = position.map(decimal);
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        if mesh != Some(primitive.mesh) {
            mesh = Some(primitive.mesh);
            let _ = writeln!(faces, "o mesh{}", primitive.mesh);
        }
        let _ = writeln!(
            faces,
            "g mesh{}/prim{}",
            primitive.mesh, primitive.primitive
        );
        if let Some(material) = primitive.material {
            let _ = writeln!(faces, "usemtl material{material}");
        }
        for (f, face) in primitive.triangles.iter().enumerate() {
            faces.push(b'f');
            for (k, &vertex) in face.iter().enumerate() {
                let vertex = vertex + first_vertex;
                let _ = match &corners {
                    Some(corners) => {
                        let number = lines.number(vertex, corners[f][k], "\n");
                        write!(faces, " {vertex}/{number}")
                    }
                    None => write!(faces, " {vertex}"),
                };
            }
            faces.push(b'\n');
        }
        if corners.is_some() {
            notes.primitives.push(note(primitive, false));
        }
        first_vertex += primitive.positions.len() as u32;
    }
    if primitives.len() > 1 {
        notes.warnings.push(Warning::new(
            "transforms_lost",
            "the OBJ file holds each mesh once, without the transforms of nodes",
        ));
    }
    text.extend(lines.text);
    text.extend(faces);
    let files = vec![(format!("{}.obj", options.stem), text)];
    Ok(Written { files, notes })
}

/// OBJ has one UV set.
pub(super) fn only_set(options: &WriteOptions) -> Result<(), DocumentError> {
    match options.texcoord {
        None | Some(0) => Ok(()),
        Some(n) => Err(DocumentError::UnsupportedOutput(format!(
            "UV set {n} to OBJ, which has set 0 only"
        ))),
    }
}

/// What happens to a primitive in an OBJ file: corners have UVs of their own, so no vertex is split.
pub(super) fn note(primitive: &Primitive, replaced: bool) -> PrimitiveNote {
    PrimitiveNote {
        mesh: primitive.mesh,
        primitive: primitive.primitive,
        texcoord: 0,
        replaced,
        vertices_before: primitive.positions.len(),
        vertices_after: primitive.positions.len(),
        indices_widened: false,
        converted_to_triangles: false,
        tangents: TangentsNote::Untouched,
    }
}
