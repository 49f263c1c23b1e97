//! Medit `.mesh`, text: sections of a keyword, a count and that number of lines, each ending in a reference number.
//!
//! Vertices, triangles and tetrahedra are read, references are not. Sections that describe properties of vertices,
//! edges and normals (corners, ridges, required ones) are skipped; elements of other shapes are refused, as the mesh
//! would have holes without them. No crate for the format was found.
use super::cursor::Cursor;
use super::elements::{Elements, push_element};
use super::{ReadError, position};
use std::fmt::Write;

/// Returns whether the text begins with the format's first keyword.
pub(super) fn has_header(text: &[u8]) -> bool {
    text.starts_with(b"MeshVersionFormatted")
}

/// Reads a text `.mesh` file of two or three dimensions.
pub fn read(bytes: &[u8]) -> Result<Elements, ReadError> {
    let mut cursor = Cursor::new(bytes, "Medit");
    let mut elements = Elements::default();
    let mut dimension = 3;
    if cursor.peek_word() != Some(b"MeshVersionFormatted") {
        return Err(cursor.malformed("expected MeshVersionFormatted"));
    }
    while let Some(word) = cursor.word() {
        match word {
            b"End" => break,
            b"MeshVersionFormatted" => {
                let _version: u32 = cursor.parse("expected a version")?;
            }
            b"Dimension" => {
                dimension = cursor.parse("expected a dimension")?;
                if !matches!(dimension, 2 | 3) {
                    return Err(cursor.malformed("the dimension is neither 2 nor 3"));
                }
            }
            b"Vertices" => read_vertices(&mut cursor, dimension, &mut elements)?,
            b"Triangles" => {
                let n_vertices = elements.vertices.len();
                read_section(&mut cursor, &mut elements.triangles, n_vertices)?;
            }
            b"Tetrahedra" => {
                let n_vertices = elements.vertices.len();
                read_section(&mut cursor, &mut elements.tets, n_vertices)?;
            }
            b"Quadrilaterals" | b"Hexahedra" | b"Prisms" | b"Pyramids" if cursor.size()? > 0 => {
                return Err(cursor.malformed("only triangles and tetrahedra are supported"));
            }
            _ if word.starts_with(b"#") => cursor.end_line(),
            // The keyword or a number of a skipped section.
            _ => {}
        }
    }
    Ok(elements)
}

fn read_vertices(
    cursor: &mut Cursor,
    dimension: u32,
    elements: &mut Elements,
) -> Result<(), ReadError> {
    for _ in 0..cursor.size()? {
        let (x, y) = (cursor.float()?, cursor.float()?);
        let z = if dimension == 3 { cursor.float()? } else { 0.0 };
        let _reference: f64 = cursor.parse("expected a reference number")?;
        let point = position([x, y, z], elements.vertices.len())?;
        elements.vertices.push(point);
    }
    Ok(())
}

fn read_section<const N: usize>(
    cursor: &mut Cursor,
    section: &mut Vec<[u32; N]>,
    n_vertices: usize,
) -> Result<(), ReadError> {
    for _ in 0..cursor.size()? {
        let mut corners = [0; N];
        for corner in &mut corners {
            *corner = cursor.parse("expected a vertex index")?;
        }
        let _reference: f64 = cursor.parse("expected a reference number")?;
        push_element(section, corners, 1, n_vertices)?;
    }
    Ok(())
}

/// Returns the text of the elements in three dimensions.
pub fn write(elements: &Elements) -> String {
    let n_vertices = elements.vertices.len();
    let mut text = format!("MeshVersionFormatted 2\nDimension 3\nVertices\n{n_vertices}\n");
    for [x, y, z] in &elements.vertices {
        let _ = writeln!(text, "{x:?} {y:?} {z:?} 0"); // writing to a string cannot fail
    }
    write_section(&mut text, "Triangles", &elements.triangles);
    write_section(&mut text, "Tetrahedra", &elements.tets);
    text.push_str("End\n");
    text
}

fn write_section<const N: usize>(text: &mut String, keyword: &str, section: &[[u32; N]]) {
    if section.is_empty() {
        return;
    }
    let _ = writeln!(text, "{keyword}\n{}", section.len());
    for corners in section {
        for &corner in corners {
            let _ = write!(text, "{} ", u64::from(corner) + 1);
        }
        text.push_str("0\n");
    }
}
