//! New OBJ files for triangles from another format.

use super::obj_text::{TexcoordLines, decimal, push_face};
use super::{
    Corners, DocumentError, NewUvs, Primitive, PrimitiveNote, TangentsNote, WriteNotes,
    WriteOptions, Written,
};
use crate::io::obj::Corner;
use std::collections::HashMap;
use std::io::Write as _;
use unwrapd_maps::mesh::VAxis;

/// A primitive with all its data in an OBJ file.
pub(super) struct ObjPart<'a> {
    pub primitive: &'a Primitive,
    /// Name of its object.
    pub object: &'a str,
    pub material: Option<&'a str>,
    /// UVs per face, v up.
    pub uvs: Option<Vec<Corners>>,
    /// Normals per face.
    pub normals: Option<Vec<[[f32; 3]; 3]>>,
    /// Colors per vertex.
    pub colors: Option<Vec<Color>>,
}

/// Writes triangles without a document around them as one object.
pub(super) fn write(
    primitive: &Primitive,
    colors: Option<&[Color]>,
    uvs: &NewUvs,
    options: &WriteOptions,
) -> Result<Written, DocumentError> {
    only_set(options)?;
    let part = ObjPart {
        primitive,
        object: "mesh0",
        material: None,
        uvs: uvs.toward(0, VAxis::Up),
        normals: None,
        colors: colors.map(<[Color]>::to_vec),
    };
    let notes = part.uvs.iter().map(|_| note(primitive, false));
    Ok(Written {
        notes: WriteNotes {
            primitives: notes.collect(),
            ..WriteNotes::default()
        },
        files: vec![(format!("{}.obj", options.stem), text(&[part], None))],
    })
}

/// Returns the text of an OBJ file: each primitive with vertices of its own, those of one object after the other.
pub(super) fn text(parts: &[ObjPart], material_file: Option<&str>) -> Vec<u8> {
    let mut vertices = Vec::new();
    if let Some(name) = material_file {
        let _ = writeln!(vertices, "mtllib {name}");
    }
    let mut lines = ObjLines::default();
    let mut faces = Vec::new();
    let mut first_vertex = 0;
    let mut object = None;
    for part in parts {
        push_vertices(&mut vertices, part);
        // Writing to memory does not fail.
        if object != Some(part.object) {
            object = Some(part.object);
            let _ = writeln!(faces, "o {}", part.object);
        }
        if let Some(material) = part.material {
            let _ = writeln!(faces, "usemtl {material}");
        }
        push_faces(&mut faces, part, first_vertex, &mut lines);
        first_vertex += part.primitive.positions.len() as u32;
    }
    [vertices, lines.texcoords.text, lines.normals, faces].concat()
}

fn push_vertices(text: &mut Vec<u8>, part: &ObjPart) {
    for (vertex, position) in part.primitive.positions.iter().enumerate() {
        let [x, y, z] = position.map(decimal);
        let _ = write!(text, "v {x} {y} {z}");
        if let Some(colors) = &part.colors {
            let [r, g, b] = to_srgb(colors[vertex]).map(|x| (x * 1e5).round() / 1e5);
            let _ = write!(text, " {r} {g} {b}");
        }
        text.push(b'\n');
    }
}

/// Lines to which corners refer by number.
#[derive(Default)]
struct ObjLines {
    texcoords: TexcoordLines,
    normals: Vec<u8>,
    numbers_of_normals: HashMap<[u32; 3], u32>,
}

impl ObjLines {
    /// Returns the number, from 0, of the line for a normal.
    fn normal(&mut self, normal: [f32; 3]) -> u32 {
        let next = self.numbers_of_normals.len() as u32;
        let key = normal.map(f32::to_bits);
        let number = *self.numbers_of_normals.entry(key).or_insert(next);
        if number == next {
            let [x, y, z] = normal.map(decimal);
            let _ = writeln!(self.normals, "vn {x} {y} {z}");
        }
        number
    }
}

fn push_faces(text: &mut Vec<u8>, part: &ObjPart, first_vertex: u32, lines: &mut ObjLines) {
    for (f, face) in part.primitive.triangles.iter().enumerate() {
        let corners = [0, 1, 2].map(|k| {
            let vertex = face[k] + first_vertex;
            let uv = part.uvs.as_ref().map(|uvs| uvs[f][k]);
            let texcoord = uv.map(|uv| lines.texcoords.number(vertex, uv, "\n"));
            let normal = part.normals.as_ref().map(|normals| normals[f][k]);
            let corner = Corner {
                vertex,
                texcoord: None,
                normal: normal.map(|normal| lines.normal(normal)),
            };
            (corner, texcoord)
        });
        push_face(text, corners.iter().map(|(c, t)| (c, *t)), "\n");
    }
}

/// Refuses UV sets other than 0: OBJ has only one.
pub(super) fn only_set(options: &WriteOptions) -> Result<(), DocumentError> {
    match options.texcoord {
        None | Some(0) => Ok(()),
        Some(n) => Err(DocumentError::UnsupportedOutput(format!(
            "UV set {n} to OBJ, which has set 0 only"
        ))),
    }
}

/// Returns the note on a primitive in an OBJ file: corners have UVs of their own, so no vertex is split.
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
        sources: None,
    }
}

// Colors of vertices: sRGB in PLY and OBJ, linear in glTF.

/// Red, green, blue and alpha, linear.
pub(super) type Color = [f32; 4];

/// The neutral color.
pub(super) const WHITE: Color = [1.0; 4];

/// Converts sRGB to linear light, clamped to the unit interval; alpha is not converted.
pub(super) fn from_srgb([r, g, b, a]: [f64; 4]) -> Color {
    let linear = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        if x <= 0.040_45 {
            x / 12.92
        } else {
            ((x + 0.055) / 1.055).powf(2.4)
        }
    };
    [linear(r), linear(g), linear(b), a.clamp(0.0, 1.0)].map(|x| x as f32)
}

/// Converts a color to sRGB, without its alpha.
fn to_srgb([r, g, b, _]: Color) -> [f64; 3] {
    [r, g, b].map(|x| {
        let x = f64::from(x).clamp(0.0, 1.0);
        if x <= 0.003_130_8 {
            12.92 * x
        } else {
            1.055 * x.powf(1.0 / 2.4) - 0.055
        }
    })
}

/// Returns the color of three or four linear numbers.
pub(super) fn from_linear(channels: &[f64]) -> Color {
    std::array::from_fn(|k| channels.get(k).map_or(1.0, |x| x.clamp(0.0, 1.0) as f32))
}
