//! OFF, the text format of Geomview: `OFF`, counts, one vertex a line, one polygon a line.
//!
//! In all variants (`[ST][C][N]OFF`) the coordinates come first on a vertex line; the numbers after them (normals,
//! colors, texture coordinates) are skipped, and so are the colors of faces. Four-dimensional and binary files are
//! refused. The counts are read as `u64` and nothing is allocated by them.
use super::{
    Coordinate, Elements, Faces, IndexedTriangles, ReadError, any_position, lines, number,
    three_numbers, words,
};
use std::fmt::Write;

fn malformed(line: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "OFF",
        place: "line",
        at: line,
        cause,
    }
}

fn is_keyword(word: &[u8]) -> bool {
    word.strip_suffix(b"OFF").is_some_and(|prefix| {
        prefix
            .iter()
            .all(|b| matches!(b, b'S' | b'T' | b'C' | b'N' | b'4' | b'n'))
    })
}

/// Iterates over the nonempty lines, without comments.
fn statements(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    lines(bytes)
        .map(|(n, line)| (n, line.split(|&b| b == b'#').next().unwrap_or_default()))
        .filter(|(_, line)| words(line).next().is_some())
}

/// Returns whether the text begins with one of the format's keywords.
pub(super) fn has_header(bytes: &[u8]) -> bool {
    statements(&bytes[..bytes.len().min(4096)])
        .next()
        .and_then(|(_, line)| words(line).next())
        .is_some_and(is_keyword)
}

/// Reads a text OFF file.
pub fn read(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    read_as(bytes)
}

pub(super) fn read_as<T: Coordinate>(bytes: &[u8]) -> Result<IndexedTriangles<T>, ReadError> {
    let mut statements = statements(bytes);
    let (n_vertices, n_faces) = counts(&mut statements)?;
    let mut mesh = IndexedTriangles::default();
    let end = malformed(lines(bytes).count(), "the file ends early");
    for _ in 0..n_vertices {
        let (at, line) = statements.next().ok_or_else(|| end.clone())?;
        let coordinates = three_numbers(&mut words(line))
            .ok_or_else(|| malformed(at, "a vertex needs three numbers"))?;
        mesh.positions.push(any_position(coordinates));
    }
    let (mut faces, mut polygon) = (Faces::default(), Vec::new());
    for _ in 0..n_faces {
        let (at, line) = statements.next().ok_or_else(|| end.clone())?;
        read_polygon(line, &mut polygon)
            .ok_or_else(|| malformed(at, "a face needs a count and that many indices"))?;
        faces.push_checked(&polygon, mesh.positions.len(), at)?;
    }
    (mesh.triangles, mesh.fanned) = faces.filled(|v| (v, mesh.positions[v as usize]))?;
    Ok(mesh)
}

/// Reads the numbers of vertices and faces, on the line of the keyword or on the next.
fn counts<'a>(
    statements: &mut impl Iterator<Item = (usize, &'a [u8])>,
) -> Result<(u64, u64), ReadError> {
    let mut at = 1;
    for (line_number, line) in statements {
        at = line_number;
        let mut words = words(line).peekable();
        if let Some(keyword) = words.next_if(|w| is_keyword(w)) {
            if keyword.iter().any(|b| matches!(b, b'4' | b'n')) {
                return Err(malformed(at, "only three-dimensional files are supported"));
            }
            if words.peek().is_none() {
                continue;
            }
        }
        let mut count = || words.next().and_then(number::<u64>);
        return match (count(), count()) {
            (Some(n_vertices), Some(n_faces)) => Ok((n_vertices, n_faces)),
            _ => Err(malformed(at, "expected the numbers of vertices and faces")),
        };
    }
    Err(malformed(at, "the file ends before its counts"))
}

fn read_polygon(line: &[u8], polygon: &mut Vec<i64>) -> Option<()> {
    let mut words = words(line);
    let n_corners: usize = number(words.next()?)?;
    polygon.clear();
    for _ in 0..n_corners {
        polygon.push(number(words.next()?)?);
    }
    Some(())
}

/// Returns the text of a surface: the triangles, or else the boundary of the tetrahedra.
pub fn write(elements: &Elements) -> String {
    let triangles = elements.surface();
    let mut text = format!("OFF\n{} {} 0\n", elements.vertices.len(), triangles.len());
    for [x, y, z] in &elements.vertices {
        let _ = writeln!(text, "{x:?} {y:?} {z:?}"); // writing to a string cannot fail
    }
    for [a, b, c] in triangles.iter() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}
