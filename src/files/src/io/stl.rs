//! STL, text and binary.
//!
//! The format has no vertices, only three positions for each facet; bit-equal positions become one vertex here. Normals
//! are ignored. Read without a library: the available ones read only the first of several solids, refuse facets whose
//! normal is NaN (which exporters write for slivers), and take a binary file for text if its header happens to begin
//! with `solid`.
use super::{Faces, IndexedTriangles, ReadError, lines, position, three_numbers, words};
use std::collections::HashMap;

/// Size of the header in bytes: 80 bytes and the number of facets.
const HEADER: usize = 84;
/// Size of a facet in bytes: a normal, three positions, and a number of two bytes.
const FACET: usize = 50;

fn malformed(place: &'static str, at: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "STL",
        place,
        at,
        cause,
    }
}

fn claimed_facets(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

/// Returns whether the file has room for the binary facets that it claims, at least one. Bytes after the last facet are
/// ignored: some exporters append their own data. A text would claim hundreds of millions.
pub(super) fn is_binary(head: &[u8], size: u64) -> bool {
    claimed_facets(head).is_some_and(|n: usize| n > 0 && (HEADER + n * FACET) as u64 <= size)
}

/// Returns whether a text file begins like this: with its first word, and facets after it.
pub(super) fn is_text(head: &[u8]) -> bool {
    has_text_header(head)
        && head
            .windows(5)
            .any(|word| word.eq_ignore_ascii_case(b"facet"))
}

/// Returns whether the file begins like a text file.
fn has_text_header(bytes: &[u8]) -> bool {
    let first = words(&bytes[..bytes.len().min(4096)]).next();
    first.is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// Reads a text or binary STL file. The size decides, as binary headers may begin with `solid` too.
pub fn read(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    if has_text_header(bytes) && !is_binary(bytes, bytes.len() as u64) {
        read_text(bytes)
    } else {
        read_binary(bytes)
    }
}

/// Vertices found so far, keyed by the bits of their position.
#[derive(Default)]
struct Builder {
    positions: Vec<[f32; 3]>,
    faces: Faces,
    vertices: HashMap<[u32; 3], u32>,
}

impl Builder {
    fn vertex(&mut self, coordinates: [f64; 3]) -> Result<u32, ReadError> {
        let position = position(coordinates, self.positions.len())?;
        let next = self.positions.len() as u32;
        let vertex = *self
            .vertices
            .entry(position.map(f32::to_bits))
            .or_insert(next);
        if vertex == next {
            self.positions.push(position);
        }
        Ok(vertex)
    }

    fn mesh(self) -> Result<IndexedTriangles, ReadError> {
        let (triangles, fanned) = self
            .faces
            .filled(|v: u32| (v, self.positions[v as usize]))?;
        Ok(IndexedTriangles {
            positions: self.positions,
            triangles,
            fanned,
        })
    }
}

fn read_binary(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    let n_facets = claimed_facets(bytes)
        .ok_or_else(|| malformed("byte", bytes.len(), "the file ends in its header"))?;
    let facets = bytes[HEADER..].chunks_exact(FACET);
    if facets.len() < n_facets {
        return Err(malformed("byte", bytes.len(), "the file ends early"));
    }
    let mut builder = Builder::default();
    for (at, facet) in facets.take(n_facets).enumerate() {
        let coordinate = |k: usize| {
            let at = 12 + 4 * k;
            f64::from(f32::from_le_bytes([
                facet[at],
                facet[at + 1],
                facet[at + 2],
                facet[at + 3],
            ]))
        };
        let mut polygon = [0; 3];
        for (c, corner) in polygon.iter_mut().enumerate() {
            *corner = builder.vertex([0, 1, 2].map(|axis| coordinate(3 * c + axis)))?;
        }
        builder.faces.push(&polygon, at);
    }
    builder.mesh()
}

fn read_text(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    let mut builder = Builder::default();
    let mut polygon = Vec::new();
    let mut inside = false;
    let mut last = 1;
    for (at, line) in lines(bytes) {
        last = at;
        let mut words = words(line);
        let keyword = words.next().unwrap_or_default().to_ascii_lowercase();
        match keyword.as_slice() {
            b"facet" => {
                if inside {
                    return Err(malformed("line", at, "the previous facet has no end"));
                }
                inside = true;
                polygon.clear();
            }
            b"vertex" => {
                let coordinates = three_numbers(&mut words)
                    .ok_or_else(|| malformed("line", at, "a vertex needs three numbers"))?;
                polygon.push(builder.vertex(coordinates)?);
            }
            b"endfacet" => {
                if !inside || polygon.len() < 3 {
                    return Err(malformed("line", at, "a facet needs three vertices"));
                }
                inside = false;
                builder.faces.push(&polygon, at);
            }
            b"" | b"solid" | b"endsolid" | b"outer" | b"endloop" => {}
            _ => return Err(malformed("line", at, "an unknown statement")),
        }
    }
    if inside {
        return Err(malformed("line", last, "the file ends early"));
    }
    builder.mesh()
}
