//! `.tet`: a line `n m`, then n lines `x y z` and m lines of four vertex indices from 0.

use super::cursor::Cursor;
use super::elements::{Elements, push_element};
use super::{ReadError, lines, position, words};
use std::fmt::Write;

/// Returns whether the first line of the text is two numbers, the counts of vertices and tetrahedra.
pub(super) fn has_counts(text: &[u8]) -> bool {
    let line = lines(text).next().map_or(&[][..], |(_, line)| line);
    words(line).count() == 2 && words(line).flatten().all(u8::is_ascii_digit)
}

/// Reads a `.tet` file.
pub fn read(bytes: &[u8]) -> Result<Elements, ReadError> {
    let mut cursor = Cursor::new(bytes, "TET");
    let mut elements = Elements::default();
    let (n_vertices, n_tets) = (cursor.size()?, cursor.size()?);
    for vertex in 0..n_vertices {
        let point = position(cursor.point()?, vertex as usize)?;
        elements.vertices.push(point);
    }
    for _ in 0..n_tets {
        let mut corners = [0; 4];
        for corner in &mut corners {
            *corner = cursor.parse("expected a vertex index")?;
        }
        push_element(&mut elements.tets, corners, 0, elements.vertices.len())?;
    }
    if cursor.word().is_some() {
        return Err(cursor.malformed("the file continues after its elements"));
    }
    Ok(elements)
}

/// Returns the text of the tetrahedra.
pub fn write(elements: &Elements) -> String {
    let mut text = format!("{} {}\n", elements.vertices.len(), elements.tets.len());
    for [x, y, z] in &elements.vertices {
        let _ = writeln!(text, "{x:?} {y:?} {z:?}"); // writing to a string cannot fail
    }
    for [a, b, c, d] in &elements.tets {
        let _ = writeln!(text, "{a} {b} {c} {d}");
    }
    text
}
