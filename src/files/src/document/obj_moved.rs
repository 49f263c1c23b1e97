//! An OBJ text with moved positions and normals.
use super::SpaceMap;
use super::obj_text::{line_end, push_comment, push_face, push_statement};
use super::texcoord_lines::decimal;
use crate::io::obj::{Corner, Obj, statements};
use std::collections::HashMap;
use std::io::Write as _;

/// Rewrites the statements of `bytes`, from which `obj` and `positions` were read.
///
/// The rest of a vertex line after the position is kept. Vertices may share a normal that the map moves apart: every
/// pair of vertex and normal gets one of its own. These lines come before the first face.
pub(super) fn moved(
    bytes: &[u8],
    obj: &Obj,
    positions: &[[f32; 3]],
    map: &dyn SpaceMap,
) -> Vec<u8> {
    let line_end = line_end(bytes);
    let normals = Normals::new(obj);
    let mut normal_lines = normals.lines(obj, positions, map, line_end);
    let mut places = map.positions(positions).into_iter();
    let mut polygons = obj.polygons();
    let mut text = Vec::with_capacity(bytes.len());
    for statement in statements(bytes) {
        match statement.keyword {
            b"v" => {
                let place = places.next().unwrap_or_default();
                let place = place.map(|x| decimal(x).into_bytes());
                let rest = statement.words.iter().skip(3).map(|word| word.to_vec());
                let words: Vec<Vec<u8>> = place.into_iter().chain(rest).collect();
                push_statement(&mut text, &statement, &words, line_end);
            }
            b"vn" => push_comment(&mut text, &statement, line_end),
            b"f" | b"fo" if !obj.normals.is_empty() => {
                text.append(&mut normal_lines);
                push_comment(&mut text, &statement, line_end);
                let corners = normals.renumbered(polygons.next().unwrap_or_default());
                let with_texcoords = corners.iter().map(|c| (c, c.texcoord.map(|t| t + 1)));
                push_face(&mut text, with_texcoords, line_end);
            }
            _ => text.extend_from_slice(statement.raw),
        }
    }
    text
}

/// Pairs of vertex and normal, numbered from 0 in the order of their first use.
#[derive(Default)]
struct Normals {
    pairs: Vec<(u32, u32)>,
    numbers: HashMap<(u32, u32), u32>,
}

impl Normals {
    fn new(obj: &Obj) -> Self {
        let mut normals = Self::default();
        for corner in &obj.corners {
            let Some(normal) = corner.normal else {
                continue;
            };
            let pair = (corner.vertex, normal);
            let next = normals.pairs.len() as u32;
            if *normals.numbers.entry(pair).or_insert(next) == next {
                normals.pairs.push(pair);
            }
        }
        normals
    }

    /// Returns the `vn` lines.
    fn lines(
        &self,
        obj: &Obj,
        positions: &[[f32; 3]],
        map: &dyn SpaceMap,
        line_end: &str,
    ) -> Vec<u8> {
        let at = |&(vertex, normal): &(u32, u32)| {
            (positions[vertex as usize], obj.normals[normal as usize])
        };
        let (places, normals): (Vec<_>, Vec<_>) = self.pairs.iter().map(at).unzip();
        let mut text = Vec::new();
        for normal in map.normals(&places, &normals) {
            let [x, y, z] = normal.map(decimal);
            // Writing to memory does not fail.
            let _ = write!(text, "vn {x} {y} {z}{line_end}");
        }
        text
    }

    fn renumbered(&self, polygon: &[Corner]) -> Vec<Corner> {
        let renumbered = |corner: &Corner| Corner {
            normal: corner.normal.map(|n| self.numbers[&(corner.vertex, n)]),
            ..*corner
        };
        polygon.iter().map(renumbered).collect()
    }
}
