//! OBJ: vertices, texture coordinates and polygons, with everything needed to write the same file again.
//!
//! Read without a library: the available ones give triangles grouped by material, while a file that is to be written
//! back needs its polygons in order and every other statement ([`statements`]) unchanged.
//!
//! A vertex may be named before it is defined; a negative index counts back from the vertices defined so far. A
//! position that does not exist is an error. A texture coordinate or normal that does not exist counts as not given, as
//! neither is needed to map the surface.
use super::{
    Coordinate, Elements, Faces, IndexedTriangles, ReadError, any_position, number, three_numbers,
    words,
};
use std::fmt::Write;

/// One corner of a polygon. Indices count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Index of the position.
    pub vertex: u32,
    /// Index of the texture coordinate.
    pub texcoord: Option<u32>,
    /// Index of the normal.
    pub normal: Option<u32>,
}

/// An OBJ file.
#[derive(Debug, Clone, Default)]
pub struct Obj<T = f32> {
    /// Positions and the triangles of all polygons, in the file's order.
    pub mesh: IndexedTriangles<T>,
    /// Texture coordinates as in the file, v up.
    pub texcoords: Vec<[f64; 2]>,
    /// Normals.
    pub normals: Vec<[f32; 3]>,
    /// Corners of all polygons, one polygon after the other.
    pub corners: Vec<Corner>,
    /// For each polygon the end of its corners in `corners`.
    pub polygon_ends: Vec<usize>,
    /// Triangles of `mesh` again, as indices into `corners`: n − 2 for each polygon of n corners, one polygon after the
    /// other.
    pub corner_triangles: Vec<[u32; 3]>,
}

impl<T> Obj<T> {
    /// Iterates over the polygons in the file's order; those of fewer than three corners have no triangles.
    pub fn polygons(&self) -> impl Iterator<Item = &[Corner]> {
        let mut start = 0;
        self.polygon_ends.iter().map(move |&end| {
            let polygon = &self.corners[start..end];
            start = end;
            polygon
        })
    }
}

/// One statement: a line, or several joined by a backslash at their ends.
#[derive(Debug, Clone)]
pub struct Statement<'a> {
    /// Number of its first line, from 1.
    pub line: usize,
    /// Text with its line ending.
    pub raw: &'a [u8],
    /// First word; empty for blank lines and comments.
    pub keyword: &'a [u8],
    /// Words after the keyword, up to a comment.
    pub words: Vec<&'a [u8]>,
}

fn malformed(line: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "OBJ",
        place: "line",
        at: line,
        cause,
    }
}

/// Iterates over the statements of a file; their `raw` texts one after the other are the file.
pub fn statements(bytes: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let mut rest = bytes;
    let mut line = 1;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let (raw, n_lines) = statement_text(rest);
        rest = &rest[raw.len()..];
        let text = raw.split(|&b| b == b'#').next().unwrap_or_default();
        let mut words = words(text).filter(|word| *word != b"\\");
        let statement = Statement {
            line,
            raw,
            keyword: words.next().unwrap_or_default(),
            words: words.collect(),
        };
        line += n_lines;
        Some(statement)
    })
}

/// Returns the first statement with its ending, and its number of lines. A comment is not continued.
fn statement_text(bytes: &[u8]) -> (&[u8], usize) {
    let mut end = 0;
    let mut n_lines = 0;
    loop {
        let line = &bytes[end..];
        let Some(length) = line.iter().position(|&b| b == b'\n' || b == b'\r') else {
            return (bytes, n_lines + 1);
        };
        n_lines += 1;
        end += length
            + if line[length..].starts_with(b"\r\n") {
                2
            } else {
                1
            };
        let line = &line[..length];
        if !line.ends_with(b"\\") || line.contains(&b'#') {
            return (&bytes[..end], n_lines);
        }
    }
}

/// Returns whether the text has a line that defines a vertex.
pub(super) fn has_vertex(text: &[u8]) -> bool {
    !text.contains(&0)
        && text
            .split(|byte| matches!(byte, b'\n' | b'\r'))
            .any(|line: &[u8]| {
                let line = line.trim_ascii_start();
                line.starts_with(b"v ") || line.starts_with(b"v\t")
            })
}

/// A corner as in the text: indices from 1, negative ones already resolved, 0 if not given.
type RawCorner = [i64; 3];

/// Reads an OBJ file.
pub fn read(bytes: &[u8]) -> Result<Obj, ReadError> {
    read_as(bytes)
}

pub(super) fn read_as<T: Coordinate>(bytes: &[u8]) -> Result<Obj<T>, ReadError> {
    let mut obj = Obj::default();
    let mut raw_corners: Vec<RawCorner> = Vec::new();
    let (mut faces, mut polygon) = (Faces::default(), Vec::new());
    for statement in statements(bytes) {
        // Read vertices and raw corners; corners may precede the vertices they name.
        let words = &mut statement.words.iter().copied();
        match statement.keyword {
            b"v" => {
                let coordinates = three_numbers(words)
                    .ok_or_else(|| malformed(statement.line, "a vertex needs three numbers"))?;
                obj.mesh.positions.push(any_position(coordinates));
            }
            b"vt" => obj.texcoords.push(texcoord(words)),
            b"vn" => obj
                .normals
                .push(three_numbers(words).map_or([f32::NAN; 3], |n| n.map(|x| x as f32))),
            b"f" | b"fo" => {
                let defined = [
                    obj.mesh.positions.len(),
                    obj.texcoords.len(),
                    obj.normals.len(),
                ];
                let start = raw_corners.len();
                for word in words {
                    let corner = raw_corner(word, defined);
                    raw_corners.push(corner.ok_or_else(|| {
                        malformed(statement.line, "a corner is not a vertex index")
                    })?);
                }
                obj.polygon_ends.push(raw_corners.len());
                let end = u32::try_from(raw_corners.len());
                let end = end.map_err(|_| malformed(statement.line, "too many corners"))?;
                polygon.clear();
                polygon.extend(start as u32..end);
                faces.push(&polygon, statement.line);
            }
            _ => {}
        }
    }
    // Resolve corners and fill polygons.
    resolve(&mut obj, &raw_corners)?;
    let vertex_of = |corner: u32| obj.corners[corner as usize].vertex;
    (obj.corner_triangles, obj.mesh.fanned) = faces.filled(|corner: u32| {
        let vertex = vertex_of(corner);
        (vertex, obj.mesh.positions[vertex as usize])
    })?;
    obj.mesh.triangles = obj
        .corner_triangles
        .iter()
        .map(|t| t.map(vertex_of))
        .collect();
    Ok(obj)
}

/// Parses one or two numbers; anything else becomes NaN, which the measures report.
fn texcoord<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> [f64; 2] {
    let mut next = |default| {
        words
            .next()
            .map_or(default, |w| number(w).unwrap_or(f64::NAN))
    };
    [next(f64::NAN), next(0.0)]
}

fn raw_corner(word: &[u8], defined: [usize; 3]) -> Option<RawCorner> {
    let mut corner = [0; 3];
    for (k, text) in word.split(|&b| b == b'/').enumerate() {
        let slot = corner.get_mut(k)?;
        if text.is_empty() && k > 0 {
            continue;
        }
        let index: i64 = number(text)?;
        *slot = if index < 0 {
            // Before the first one: kept negative, so that it is found out of range.
            let resolved = index.checked_add(defined[k] as i64 + 1)?;
            if resolved > 0 { resolved } else { i64::MIN }
        } else {
            index
        };
    }
    Some(corner)
}

/// Checks the corners against the definitions of the whole file.
fn resolve<T>(obj: &mut Obj<T>, raw_corners: &[RawCorner]) -> Result<(), ReadError> {
    let n_vertices = obj.mesh.positions.len();
    let optional = |index: i64, n: usize| {
        let index = u32::try_from(index.checked_sub(1)?).ok()?;
        ((index as usize) < n).then_some(index)
    };
    obj.corners.reserve_exact(raw_corners.len());
    for corner in raw_corners {
        let vertex = optional(corner[0], n_vertices).ok_or(ReadError::IndexOutOfRange {
            index: corner[0].saturating_sub(1),
            n_vertices,
        })?;
        obj.corners.push(Corner {
            vertex,
            texcoord: optional(corner[1], obj.texcoords.len()),
            normal: optional(corner[2], obj.normals.len()),
        });
    }
    Ok(())
}

/// Returns the text of a surface: the triangles, or else the boundary of the tetrahedra.
pub fn write(elements: &Elements) -> String {
    let mut text = String::new();
    for [x, y, z] in &elements.vertices {
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}"); // writing to a string cannot fail
    }
    for triangle in elements.surface().iter() {
        let [a, b, c] = triangle.map(|v| u64::from(v) + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}
