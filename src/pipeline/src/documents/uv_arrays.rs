//! UVs of a result as plain arrays, for programs that keep the mesh that they sent.

use super::input::Origins;
use unwrapd_files::document::{Corners, Document, NewUvs, PrimitiveNote};
use unwrapd_maps::mesh::VAxis;

/// First bytes of the file: type and version.
const MAGIC: [u8; 4] = *b"UVS1";

/// UVs of every corner, and the origins of faces and vertices.
#[derive(Clone, Debug)]
pub struct UvArrays(Vec<Arrays>);

/// Arrays of a written primitive.
#[derive(Clone, Debug)]
struct Arrays {
    mesh: u32,
    primitive: u32,
    uvs: Vec<Corners>,
    /// Index of each face in the input.
    faces: Vec<u32>,
    /// Index of each vertex in the input.
    vertices: Vec<u32>,
}

impl UvArrays {
    /// Collects what was written of `uvs`, with v as in the written file. `notes` describe the written document, and
    /// `origins` its relation to the input.
    pub fn new(
        document: &Document,
        uvs: &NewUvs,
        v_axis: VAxis,
        notes: &[PrimitiveNote],
        origins: &Origins,
    ) -> Self {
        let mut notes = notes.iter().peekable();
        let mut first = [0, 0];
        let mut all = Vec::new();
        for (index, primitive) in document.primitives().iter().enumerate() {
            let note = notes.next_if(|note: &&PrimitiveNote| {
                (note.mesh, note.primitive) == (primitive.mesh, primitive.primitive)
            });
            if let (Some(note), Some(uvs)) = (note, uvs.toward(index, v_axis)) {
                all.push(Arrays {
                    mesh: note.mesh as u32,
                    primitive: note.primitive as u32,
                    faces: originals(0..uvs.len() as u32, first[1], origins.faces.as_deref()),
                    vertices: originals(sources(note), first[0], origins.vertices.as_deref()),
                    uvs,
                });
            }
            first[0] += primitive.positions.len();
            first[1] += primitive.triangles.len();
        }
        Self(all)
    }

    /// Returns the file that `getUvs` of the API describes: numbers of 4 bytes, little-endian.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        let mut push = |numbers: &[u32]| {
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        };
        push(&[self.0.len() as u32]);
        for of in &self.0 {
            push(&[of.mesh, of.primitive]);
            push(&[of.uvs.len() as u32, of.vertices.len() as u32]);
        }
        for of in &self.0 {
            for face in &of.uvs {
                push(
                    &face
                        .as_flattened()
                        .iter()
                        .map(|x| x.to_bits())
                        .collect::<Vec<_>>(),
                );
            }
            push(&of.faces);
            push(&of.vertices);
        }
        bytes
    }
}

/// Returns the number in the document of each written vertex.
fn sources(note: &PrimitiveNote) -> Vec<u32> {
    note.sources
        .clone()
        .unwrap_or_else(|| (0..note.vertices_after as u32).collect())
}

/// Maps indices within a primitive to those of the input. `all` has the input's indices if the document was
/// converted; the primitive's begin at `first`.
fn originals(
    numbers: impl IntoIterator<Item = u32>,
    first: usize,
    all: Option<&[u32]>,
) -> Vec<u32> {
    numbers
        .into_iter()
        .map(|number| all.map_or(number, |all| all[first + number as usize]))
        .collect()
}
