//! An OBJ text with new texture coordinates.

use super::uvs::Corners;
use crate::io::obj::{Corner, Obj, Statement, statements};
use crate::polygon::{smallest_first, triangulate};
use std::collections::HashMap;
use std::io::Write as _;
use unwrapd_maps::mesh::UnionFind;

/// The text, and the number of polygons that had to be split.
pub(super) struct Rewritten {
    pub text: Vec<u8>,
    pub split_polygons: usize,
}

/// Rewrites the statements of `bytes`, from which `obj` and `positions` were read.
///
/// The new `vt` lines come before the first face. Positions keep their text if it is exactly the f32 that was read;
/// otherwise the text is that of the f32 ([`decimal`]), so that vertices that are one here are one for every reader.
pub(super) fn rewrite(
    bytes: &[u8],
    obj: &Obj,
    positions: &[[f32; 3]],
    uvs: &[Corners],
) -> Rewritten {
    let line_end = line_end(bytes);
    let mut lines = TexcoordLines::default();
    let mut faces = ObjFaces::new(obj, positions, uvs, &mut lines, line_end);
    let mut texcoords = std::mem::take(&mut lines.text);
    let mut text = Vec::with_capacity(bytes.len() + texcoords.len());
    for statement in statements(bytes) {
        match statement.keyword {
            b"v" => push_vertex(&mut text, &statement, line_end),
            b"vt" => push_comment(&mut text, &statement, line_end),
            b"f" | b"fo" => {
                text.append(&mut texcoords);
                push_comment(&mut text, &statement, line_end);
                faces.push_next(&mut text);
            }
            b"l" | b"surf" => push_without_texcoords(&mut text, &statement, line_end),
            _ => text.extend_from_slice(statement.raw),
        }
    }
    Rewritten {
        text,
        split_polygons: faces.split_polygons,
    }
}

/// Returns the line ending of a text.
pub(super) fn line_end(bytes: &[u8]) -> &'static str {
    let end = bytes.iter().position(|&b| b == b'\n' || b == b'\r');
    match end.map(|e| &bytes[e..]) {
        Some(rest) if rest.starts_with(b"\r\n") => "\r\n",
        _ => "\n",
    }
}

/// Returns the comment of a statement that is rewritten.
fn comment<'a>(statement: &Statement<'a>) -> Option<&'a [u8]> {
    let start = statement.raw.iter().position(|&b| b == b'#')?;
    Some(statement.raw[start..].trim_ascii_end())
}

/// Puts the comment on a line of its own, as not every reader accepts one after the corners of a face.
pub(super) fn push_comment(text: &mut Vec<u8>, statement: &Statement, line_end: &str) {
    if let Some(comment) = comment(statement) {
        text.extend_from_slice(comment);
        text.extend_from_slice(line_end.as_bytes());
    }
}

/// Writes a statement with other words, followed by its comment.
pub(super) fn push_statement(
    text: &mut Vec<u8>,
    statement: &Statement,
    words: &[Vec<u8>],
    line_end: &str,
) {
    text.extend_from_slice(statement.keyword);
    for word in words {
        text.push(b' ');
        text.extend_from_slice(word);
    }
    if let Some(comment) = comment(statement) {
        text.push(b' ');
        text.extend_from_slice(comment);
    }
    text.extend_from_slice(line_end.as_bytes());
}

fn push_vertex(text: &mut Vec<u8>, statement: &Statement, line_end: &str) {
    let mut words: Vec<Vec<u8>> = statement.words.iter().map(|w| w.to_vec()).collect();
    let one_line = !statement.raw.trim_ascii_end().contains(&b'\n');
    let mut changed = !(one_line && statement.raw.starts_with(b"v "));
    for word in words.iter_mut().take(3) {
        if let Some(decimal) = corrected(word) {
            *word = decimal.into_bytes();
            changed = true;
        }
    }
    if changed {
        push_statement(text, statement, &words, line_end);
    } else {
        text.extend_from_slice(statement.raw);
    }
}

/// Returns the text of the f32 nearest to a number, if the number differs from it.
fn corrected(word: &[u8]) -> Option<String> {
    let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    let decimal = decimal(number as f32 + 0.0);
    let written: f64 = decimal.parse().ok()?;
    (written.to_bits() != number.to_bits()).then_some(decimal)
}

/// Writes lines and surfaces without their texture coordinates, which no longer exist.
fn push_without_texcoords(text: &mut Vec<u8>, statement: &Statement, line_end: &str) {
    if !statement.words.iter().any(|word| word.contains(&b'/')) {
        text.extend_from_slice(statement.raw);
        return;
    }
    let without = |word: &&[u8]| {
        let parts: Vec<&[u8]> = word.split(|&b| b == b'/').collect();
        match parts.as_slice() {
            [vertex, _, normal] if !normal.is_empty() => [vertex, &b"//"[..], normal].concat(),
            [vertex, ..] => vertex.to_vec(),
            [] => Vec::new(),
        }
    };
    let words: Vec<Vec<u8>> = statement.words.iter().map(without).collect();
    push_statement(text, statement, &words, line_end);
}

/// Polygons with the numbers of their new texture coordinates.
struct ObjFaces<'a> {
    obj: &'a Obj,
    positions: &'a [[f32; 3]],
    /// Numbers per triangle.
    numbers: Vec<[u32; 3]>,
    /// `true` if polygons without texture coordinates stay without, and their triangles are not in `obj`.
    leaves_out: bool,
    line_end: &'static str,
    n_polygons: usize,
    n_corners: usize,
    n_triangles: usize,
    split_polygons: usize,
}

impl<'a> ObjFaces<'a> {
    fn new(
        obj: &'a Obj,
        positions: &'a [[f32; 3]],
        uvs: &[Corners],
        lines: &mut TexcoordLines,
        line_end: &'static str,
    ) -> Self {
        let numbers = obj.corner_triangles.iter().zip(uvs).map(|(corners, uvs)| {
            let vertices = corners.map(|corner| obj.corners[corner as usize].vertex);
            [0, 1, 2].map(|c| lines.number(vertices[c], uvs[c], line_end))
        });
        let n_all: usize = obj.polygons().map(|p| p.len().saturating_sub(2)).sum();
        Self {
            obj,
            positions,
            numbers: numbers.collect(),
            leaves_out: obj.corner_triangles.len() < n_all,
            line_end,
            n_polygons: 0,
            n_corners: 0,
            n_triangles: 0,
            split_polygons: 0,
        }
    }

    /// Writes the next polygon: whole if the UVs of its triangles agree, else in pieces.
    fn push_next(&mut self, text: &mut Vec<u8>) {
        let Some(&end) = self.obj.polygon_ends.get(self.n_polygons) else {
            return;
        };
        let start = std::mem::replace(&mut self.n_corners, end);
        let polygon = &self.obj.corners[start..end];
        self.n_polygons += 1;
        // A polygon without triangles has no texture coordinates.
        let is_unmapped = || polygon.iter().any(|corner| corner.texcoord.is_none());
        if polygon.len() < 3 || (self.leaves_out && is_unmapped()) {
            let corners = polygon.iter().map(|corner| (corner, None));
            push_face(text, corners, self.line_end);
            return;
        }
        // Split the polygon where its triangles disagree.
        let triangles = self.n_triangles..self.n_triangles + polygon.len() - 2;
        self.n_triangles = triangles.end;
        let numbered = NumberedPolygon {
            n_corners: polygon.len(),
            triangles: self.obj.corner_triangles[triangles.clone()]
                .iter()
                .map(|triangle: &[u32; 3]| triangle.map(|corner| corner - start as u32))
                .collect(),
            numbers: &self.numbers[triangles],
        };
        let pieces = numbered.pieces(|corner: u32| {
            let vertex = polygon[corner as usize].vertex;
            self.positions[vertex as usize].map(f64::from)
        });
        self.split_polygons += usize::from(pieces.len() > 1);
        for piece in pieces {
            let corners = piece.into_iter();
            let corners = corners.map(|(corner, number)| (&polygon[corner as usize], Some(number)));
            push_face(text, corners, self.line_end);
        }
    }
}

/// Writes a face: each corner with the number of its texture coordinate.
pub(super) fn push_face<'a>(
    text: &mut Vec<u8>,
    corners: impl Iterator<Item = (&'a Corner, Option<u32>)>,
    line_end: &str,
) {
    text.push(b'f');
    for (corner, texcoord) in corners {
        let vertex = corner.vertex + 1;
        // Writing to memory does not fail.
        let _ = match (texcoord, corner.normal.map(|normal| normal + 1)) {
            (Some(texcoord), Some(normal)) => write!(text, " {vertex}/{texcoord}/{normal}"),
            (Some(texcoord), None) => write!(text, " {vertex}/{texcoord}"),
            (None, Some(normal)) => write!(text, " {vertex}//{normal}"),
            (None, None) => write!(text, " {vertex}"),
        };
    }
    text.extend_from_slice(line_end.as_bytes());
}

// Splitting of polygons whose corners have several texture coordinates.

/// A polygon with the numbers of texture coordinates per triangle.
struct NumberedPolygon<'a> {
    pub n_corners: usize,
    /// Triangles inside it, as indices of its corners.
    pub triangles: Vec<[u32; 3]>,
    /// Numbers of their texture coordinates.
    pub numbers: &'a [[u32; 3]],
}

/// Corners in the order of the polygon, each with the number of its texture coordinate.
type PolygonPiece = Vec<(u32, u32)>;

impl NumberedPolygon<'_> {
    /// Returns the whole polygon if each corner has one number, else as few pieces as its triangles allow. A reader
    /// that triangulates a piece gets the polygon's own triangles again: pieces for which it would not are given as
    /// triangles.
    pub fn pieces(&self, position: impl Fn(u32) -> [f64; 3]) -> Vec<PolygonPiece> {
        if let Some(whole) = self.whole() {
            return vec![whole];
        }
        let mut pieces = Vec::new();
        for members in self.connected() {
            match self.outline(&members, &position) {
                Some(piece) => pieces.push(piece),
                None => pieces.extend(members.iter().map(|&t| self.triangle(t))),
            }
        }
        pieces
    }

    fn whole(&self) -> Option<PolygonPiece> {
        let mut number_of = vec![None; self.n_corners];
        let corners = self.triangles.as_flattened().iter();
        for (&corner, &number) in corners.zip(self.numbers.as_flattened()) {
            if *number_of[corner as usize].get_or_insert(number) != number {
                return None;
            }
        }
        let numbered = (0..).zip(number_of);
        numbered
            .map(|(corner, number)| Some((corner, number?)))
            .collect()
    }

    /// Returns the sets of triangles that are connected across diagonals with the same numbers on both sides, in
    /// increasing order.
    fn connected(&self) -> Vec<Vec<usize>> {
        let mut sets = UnionFind::new(self.triangles.len());
        let mut sides = HashMap::new();
        for (t, (corners, numbers)) in self.triangles.iter().zip(self.numbers).enumerate() {
            for k in 0..3 {
                let end = |k: usize| (corners[k % 3], numbers[k % 3]);
                // Neighbors run along a diagonal in opposite directions.
                if let Some(&other) = sides.get(&[end(k + 1), end(k)]) {
                    sets.unite(other, t as u32);
                }
                sides.insert([end(k), end(k + 1)], t as u32);
            }
        }
        let (labels, n) = sets.labels();
        let mut members = vec![Vec::new(); n];
        for (t, &label) in labels.iter().enumerate() {
            members[label as usize].push(t);
        }
        members
    }

    fn triangle(&self, t: usize) -> PolygonPiece {
        let corners = self.triangles[t].iter().zip(&self.numbers[t]);
        corners.map(|(&corner, &number)| (corner, number)).collect()
    }

    /// Returns the corners of connected triangles, if triangulating them gives these triangles. Among connected
    /// triangles a corner has one number, because the triangles around it are neighbors one after the other.
    fn outline(
        &self,
        members: &[usize],
        position: impl Fn(u32) -> [f64; 3],
    ) -> Option<PolygonPiece> {
        let mut piece: PolygonPiece = members.iter().flat_map(|&t| self.triangle(t)).collect();
        piece.sort_unstable();
        piece.dedup();
        // Which diagonal a flat quad gets depends on its first corner.
        for _ in 0..2 {
            let corners: Vec<[f64; 3]> =
                piece.iter().map(|&(corner, _)| position(corner)).collect();
            let mut filled = Vec::new();
            triangulate(&corners, &mut filled);
            let mut filled: Vec<[u32; 3]> = filled
                .iter()
                .map(|triangle| smallest_first(triangle.map(|k| piece[k as usize].0)))
                .collect();
            filled.sort_unstable();
            if filled
                .iter()
                .eq(members.iter().map(|&t| &self.triangles[t]))
            {
                return Some(piece);
            }
            piece.rotate_left(1);
        }
        None
    }
}

// The `vt` lines of an OBJ file, one for each pair of vertex and UV.

/// `vt` lines in the order of their first use.
#[derive(Default)]
pub(super) struct TexcoordLines {
    numbers: HashMap<(u32, [u32; 2]), u32>,
    /// Text of the lines so far.
    pub text: Vec<u8>,
}

impl TexcoordLines {
    /// Returns the number, from 1, of the line for a corner. Writes the shortest decimals that give the UV again,
    /// exactly, whether they are read as f32 or f64.
    pub fn number(&mut self, vertex: u32, uv: [f32; 2], line_end: &str) -> u32 {
        let next = self.numbers.len() as u32 + 1;
        let key = (vertex, uv.map(f32::to_bits));
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            let [u, v] = uv.map(f64::from);
            // Writing to memory does not fail.
            let _ = write!(self.text, "vt {u} {v}{line_end}");
        }
        number
    }
}

/// Returns the decimal for a coordinate in a text file: read as f32 it is `x`, and equal coordinates have equal texts.
pub(super) fn decimal(x: f32) -> String {
    x.to_string()
}
