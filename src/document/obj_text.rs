//! An OBJ text with new texture coordinates.
use super::texcoord_lines::{TexcoordLines, decimal};
use super::uvs::Corners;
use crate::mesh::io::obj::{Corner, Obj, Statement, statements};
use std::io::Write as _;

/// The text, and how many polygons had to be split.
pub(super) struct Rewritten {
    pub text: Vec<u8>,
    pub split_polygons: usize,
}

/// Goes through the statements of `bytes`, which `obj` was read from.
///
/// The new `vt` lines stand before the first face. Positions keep their text where it says what was read, f32 by f32;
/// otherwise ([`decimal`]) the text is that of the f32, so that vertices that are one here are one for every reader.
pub(super) fn rewrite(bytes: &[u8], obj: &Obj, uvs: &[Corners]) -> Rewritten {
    let line_end = line_end(bytes);
    let mut lines = TexcoordLines::default();
    let mut faces = Faces::new(obj, uvs, &mut lines, line_end);
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

fn line_end(bytes: &[u8]) -> &'static str {
    let end = bytes.iter().position(|&b| b == b'\n' || b == b'\r');
    match end.map(|e| &bytes[e..]) {
        Some(rest) if rest.starts_with(b"\r\n") => "\r\n",
        _ => "\n",
    }
}

/// The comment of a statement that is written anew.
fn comment<'a>(statement: &Statement<'a>) -> Option<&'a [u8]> {
    let start = statement.raw.iter().position(|&b| b == b'#')?;
    Some(statement.raw[start..].trim_ascii_end())
}

/// Puts the comment on a line of its own, as not every reader takes one after the corners of a face.
fn push_comment(text: &mut Vec<u8>, statement: &Statement, line_end: &str) {
    if let Some(comment) = comment(statement) {
        text.extend_from_slice(comment);
        text.extend_from_slice(line_end.as_bytes());
    }
}

fn push_statement(text: &mut Vec<u8>, statement: &Statement, words: &[Vec<u8>], line_end: &str) {
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

/// The text of the f32 nearest to a number, where the number is another.
fn corrected(word: &[u8]) -> Option<String> {
    let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    let decimal = decimal(number as f32 + 0.0);
    let written: f64 = decimal.parse().ok()?;
    (written.to_bits() != number.to_bits()).then_some(decimal)
}

/// Lines and surfaces may name texture coordinates too, and these are gone.
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

/// The polygons with the numbers of their new texture coordinates.
struct Faces<'a> {
    polygons: Box<dyn Iterator<Item = &'a [Corner]> + 'a>,
    numbers: std::vec::IntoIter<[u32; 3]>,
    line_end: &'static str,
    split_polygons: usize,
}

impl<'a> Faces<'a> {
    fn new(
        obj: &'a Obj,
        uvs: &[Corners],
        lines: &mut TexcoordLines,
        line_end: &'static str,
    ) -> Self {
        let mut numbers = Vec::with_capacity(uvs.len());
        let mut uvs = uvs.iter();
        for polygon in obj.polygons() {
            for k in 1..polygon.len().saturating_sub(1) {
                let Some(corners) = uvs.next() else { break };
                let vertices = [polygon[0].vertex, polygon[k].vertex, polygon[k + 1].vertex];
                numbers.push([0, 1, 2].map(|c| lines.number(vertices[c], corners[c], line_end)));
            }
        }
        Self {
            polygons: Box::new(obj.polygons()),
            numbers: numbers.into_iter(),
            line_end,
            split_polygons: 0,
        }
    }

    /// Writes the next polygon: whole where the UVs of its triangles agree, else in as few pieces as they allow. The
    /// fans of the pieces are the fan of the polygon.
    fn push_next(&mut self, text: &mut Vec<u8>) {
        let Some(polygon) = self.polygons.next() else {
            return;
        };
        if polygon.len() < 3 {
            let corners = polygon.iter().map(|corner| (corner, None));
            push_face(text, corners, self.line_end);
            return;
        }
        let mut piece: Vec<(&Corner, Option<u32>)> = Vec::with_capacity(polygon.len());
        let mut n_pieces = 0;
        for k in 1..polygon.len() - 1 {
            let Some([first, last, next]) = self.numbers.next() else {
                return;
            };
            let continues = piece.first().is_some_and(|corner| corner.1 == Some(first))
                && piece.last().is_some_and(|corner| corner.1 == Some(last));
            if !continues {
                if !piece.is_empty() {
                    push_face(text, piece.drain(..), self.line_end);
                }
                n_pieces += 1;
                piece.extend([(&polygon[0], Some(first)), (&polygon[k], Some(last))]);
            }
            piece.push((&polygon[k + 1], Some(next)));
        }
        push_face(text, piece.into_iter(), self.line_end);
        self.split_polygons += usize::from(n_pieces > 1);
    }
}

fn push_face<'a>(
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
