//! PLY, text and binary of both byte orders.
//!
//! A header declares elements and their properties, the data follow in that order. The reader uses `x y z` of `vertex`
//! and the list `vertex_indices` (or `vertex_index`) of `face`; everything else is skipped by its declared size
//! ([`extras`](fn@extras) has the colors). Read without a library: the maintained one refuses `nan` anywhere in a text
//! file, numbers such as `1.` and comments that are not UTF-8, and loops forever on an element that has a count but no
//! properties.
mod data;
mod extras;
mod header;

pub use self::extras::{Extras, extras};

use self::data::Data;
use self::header::{Element, Kind, header};
use super::{Faces, IndexedTriangles, ReadError, any_position};

fn malformed(at: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "PLY",
        place: "byte",
        at,
        cause,
    }
}

/// Returns whether the file begins with the format's first line.
pub(super) fn has_header(head: &[u8]) -> bool {
    head.starts_with(b"ply") && matches!(head.get(3), Some(b'\n' | b'\r' | b' '))
}

/// Reads a PLY file.
pub fn read(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    let header = header(bytes)?;
    let mut data = Data {
        bytes,
        at: header.end,
        encoding: header.encoding,
    };
    let mut mesh = IndexedTriangles::default();
    let mut faces = Faces::default();
    for element in &header.elements {
        match element.name.as_slice() {
            b"vertex" => read_vertices(element, &mut data, &mut mesh)?,
            b"face" => read_faces(element, &mut data, &mut faces)?,
            _ => read_records(element, &mut data, None, |_| Ok(()))?,
        }
    }
    let n_vertices = mesh.positions.len();
    match faces.last_corner() {
        Some(index) if index as usize >= n_vertices => Err(ReadError::IndexOutOfRange {
            index: i64::from(index),
            n_vertices,
        }),
        _ => {
            (mesh.triangles, mesh.fanned) = faces.filled(|v| (v, mesh.positions[v as usize]))?;
            Ok(mesh)
        }
    }
}

fn read_vertices(
    element: &Element,
    data: &mut Data,
    mesh: &mut IndexedTriangles,
) -> Result<(), ReadError> {
    let at = data.at;
    let axis = |name: &[u8]| {
        let found = element.properties.iter().position(|p| p.name == name);
        found.ok_or_else(|| malformed(at, "a vertex needs the properties x, y and z"))
    };
    let axes = [axis(b"x")?, axis(b"y")?, axis(b"z")?];
    read_records(element, data, None, |record| {
        let coordinates = axes.map(|property| record.scalars[property]);
        mesh.positions.push(any_position(coordinates));
        Ok(())
    })
}

/// Reads faces. They may come before the vertices: their indices are compared with the vertices at the end of the file.
fn read_faces(element: &Element, data: &mut Data, faces: &mut Faces) -> Result<(), ReadError> {
    let list = element.properties.iter().position(|p| {
        matches!(p.kind, Kind::List { .. })
            && matches!(p.name.as_slice(), b"vertex_indices" | b"vertex_index")
    });
    let mut face = 0;
    read_records(element, data, list, |record| {
        faces.push_checked(&record.list, u32::MAX as usize, face)?;
        face += 1;
        Ok(())
    })
}

/// One record: the scalars by property (a list counts as 0), and the requested list.
struct Record {
    scalars: Vec<f64>,
    list: Vec<i64>,
}

/// Reads all records of an element. Each takes at least one byte, so a false count ends with the file.
fn read_records(
    element: &Element,
    data: &mut Data,
    wanted: Option<usize>,
    mut visit: impl FnMut(&Record) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut record = Record {
        scalars: vec![0.0; element.properties.len()],
        list: Vec::new(),
    };
    for _ in 0..element.count {
        // Keep the scalars and the wanted list, and skip other lists.
        for (k, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::Scalar(scalar) => record.scalars[k] = data.next(scalar)?,
                Kind::List { count, item } => {
                    let n_items = data.next(count)?;
                    if n_items < 0.0 || n_items.fract() != 0.0 {
                        return Err(malformed(data.at, "a list has an impossible length"));
                    }
                    data.list(
                        n_items as u64,
                        item,
                        (wanted == Some(k)).then_some(&mut record.list),
                    )?;
                }
            }
        }
        visit(&record)?;
    }
    Ok(())
}
