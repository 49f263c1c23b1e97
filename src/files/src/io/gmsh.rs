//! Gmsh `.msh` of versions 2.2 and 4.1, text and binary.
//!
//! Nodes, triangles and tetrahedra are read; points and lines, which describe boundaries, and all other sections are
//! skipped. Elements of other shapes or higher order are refused, as the mesh would have holes or missing corners
//! without them. Read without a library: of the available crates `mshio` (last release 2020) reads only 4.1, `msh-rw`
//! and `rutile` (2020, 2021) call themselves unfinished; the two versions share everything except their framing.

use super::cursor::{Cursor, NumberEncoding};
use super::elements::{Elements, push_element};
use super::{ReadError, position};
use std::collections::HashMap;
use std::fmt::Write;

/// Gmsh's numbers of element types.
const TRIANGLE: i32 = 2;
const TETRAHEDRON: i32 = 4;

/// The two framings that are read.
#[derive(Clone, Copy)]
enum Version {
    V22,
    V41,
}

/// Returns whether the text begins with the format's first section.
pub(super) fn has_header(text: &[u8]) -> bool {
    text.starts_with(b"$MeshFormat")
}

/// Reads a `.msh` file.
pub fn read(bytes: &[u8]) -> Result<Elements, ReadError> {
    let mut cursor = Cursor::new(bytes, "Gmsh");
    if !cursor.skip_past(b"$MeshFormat") {
        return Err(cursor.malformed("expected $MeshFormat"));
    }
    let version = read_header(&mut cursor)?;
    let mut reader = Reader::new(cursor);
    while reader.cursor.skip_past(b"$") {
        let name = reader.cursor.word().unwrap_or_default();
        match (name, version) {
            (b"Nodes", Version::V22) => reader.nodes_22()?,
            (b"Nodes", Version::V41) => reader.nodes_41()?,
            (b"Elements", Version::V22) => reader.elements_22()?,
            (b"Elements", Version::V41) => reader.elements_41()?,
            // A skipped section may contain any byte, even `$`, up to its end mark.
            _ if name.starts_with(b"End") => {}
            _ => {
                let end = [b"$End", name].concat();
                if !reader.cursor.skip_past(&end) {
                    return Err(reader.cursor.malformed("a section has no end"));
                }
            }
        }
    }
    Ok(reader.elements)
}

/// Reads version and encoding: `version is-binary size-of-numbers`, and in binary files the number 1.
fn read_header(cursor: &mut Cursor) -> Result<Version, ReadError> {
    let version: f64 = cursor.parse("expected a version")?;
    let binary: u32 = cursor.parse("0 or 1 is expected")?;
    let size: u32 = cursor.parse("expected the size of a number")?;
    if size != 8 {
        return Err(cursor.malformed("only 8-byte numbers are supported"));
    }
    if binary == 1 {
        cursor.end_line();
        cursor.encoding = NumberEncoding::LittleEndian;
        cursor.encoding = match cursor.int()? {
            1 => NumberEncoding::LittleEndian,
            0x0100_0000 => NumberEncoding::BigEndian,
            _ => return Err(cursor.malformed("unknown byte order")),
        };
    }
    if version == 2.2 {
        Ok(Version::V22)
    } else if version == 4.1 {
        Ok(Version::V41)
    } else {
        Err(cursor.malformed("only versions 2.2 and 4.1 are supported"))
    }
}

// The sections of a file, in the framings of both versions.

/// Nodes and elements of a file read so far.
struct Reader<'a> {
    pub cursor: Cursor<'a>,
    pub elements: Elements,
    /// Vertex of each node tag; tags need not be consecutive.
    vertex_of_tag: HashMap<u64, u32>,
}

impl<'a> Reader<'a> {
    /// Creates a reader with the cursor behind the header.
    pub fn new(cursor: Cursor<'a>) -> Self {
        Self {
            cursor,
            elements: Elements::default(),
            vertex_of_tag: HashMap::new(),
        }
    }

    pub fn nodes_22(&mut self) -> Result<(), ReadError> {
        let n: u64 = self.cursor.parse("expected the number of nodes")?;
        self.begin_numbers();
        for _ in 0..n {
            let tag = self.tag_22()?;
            let point = self.cursor.point()?;
            self.push_vertex(tag, point)?;
        }
        Ok(())
    }

    pub fn nodes_41(&mut self) -> Result<(), ReadError> {
        self.begin_numbers();
        let [n_blocks, _, _, _] = self.four_sizes()?;
        let mut tags = Vec::new();
        for _ in 0..n_blocks {
            let dimension = self.cursor.int()?;
            let _entity = self.cursor.int()?;
            let n_parameters = match self.cursor.int()? {
                0 => 0,
                _ => dimension.clamp(0, 3),
            };
            let n = self.cursor.size()?;
            tags.clear();
            for _ in 0..n {
                tags.push(self.cursor.size()?);
            }
            for &tag in &tags {
                let point = self.cursor.point()?;
                for _ in 0..n_parameters {
                    self.cursor.float()?;
                }
                self.push_vertex(tag, point)?;
            }
        }
        Ok(())
    }

    pub fn elements_22(&mut self) -> Result<(), ReadError> {
        let n: u64 = self.cursor.parse("expected the number of elements")?;
        self.begin_numbers();
        let mut read = 0;
        while read < n {
            // Text: `tag type n-tags tags nodes`. Binary: a header `type n n-tags` for n of `tag tags nodes`.
            let is_text = self.cursor.encoding == NumberEncoding::Text;
            if is_text {
                self.tag_22()?;
            }
            let element_type = self.cursor.int()?;
            let n_follow = if is_text { 1 } else { self.cursor.int()? };
            let n_tags = self.cursor.int()?;
            for _ in 0..n_follow {
                for _ in 0..i64::from(n_tags) + i64::from(!is_text) {
                    self.cursor.int()?;
                }
                self.push_element(element_type, Self::tag_22)?;
                read += 1;
            }
        }
        Ok(())
    }

    pub fn elements_41(&mut self) -> Result<(), ReadError> {
        self.begin_numbers();
        let [n_blocks, _, _, _] = self.four_sizes()?;
        for _ in 0..n_blocks {
            let _dimension = self.cursor.int()?;
            let _entity = self.cursor.int()?;
            let element_type = self.cursor.int()?;
            for _ in 0..self.cursor.size()? {
                self.cursor.size()?;
                self.push_element(element_type, |reader| reader.cursor.size())?;
            }
        }
        Ok(())
    }

    /// Moves to the numbers, which in binary files begin on the line after the keyword or the count.
    fn begin_numbers(&mut self) {
        if self.cursor.encoding != NumberEncoding::Text {
            self.cursor.end_line();
        }
    }

    /// Reads the numbers of blocks and of entries, and the smallest and greatest tag.
    fn four_sizes(&mut self) -> Result<[u64; 4], ReadError> {
        let mut next = || self.cursor.size();
        Ok([next()?, next()?, next()?, next()?])
    }

    fn tag_22(&mut self) -> Result<u64, ReadError> {
        let tag = self.cursor.int()?;
        u64::try_from(tag).map_err(|_| self.cursor.malformed("a tag is negative"))
    }

    fn push_vertex(&mut self, tag: u64, point: [f64; 3]) -> Result<(), ReadError> {
        let vertex = self.elements.vertices.len();
        self.elements.vertices.push(position(point, vertex)?);
        match self.vertex_of_tag.insert(tag, vertex as u32) {
            None => Ok(()),
            Some(_) => Err(self.cursor.malformed("two nodes have the same tag")),
        }
    }

    fn push_element(
        &mut self,
        element_type: i32,
        mut tag: impl FnMut(&mut Self) -> Result<u64, ReadError>,
    ) -> Result<(), ReadError> {
        let n = n_nodes(element_type).ok_or_else(|| {
            self.cursor
                .malformed("only linear triangles and tetrahedra are supported")
        })?;
        let n_vertices = self.elements.vertices.len();
        let mut nodes = [0; 6];
        for node in &mut nodes[..n] {
            let tag = tag(self)?;
            let vertex = self.vertex_of_tag.get(&tag);
            *node = i64::from(*vertex.ok_or(ReadError::IndexOutOfRange {
                index: tag as i64,
                n_vertices,
            })?);
        }
        let [a, b, c, d, ..] = nodes;
        match element_type {
            TRIANGLE => push_element(&mut self.elements.triangles, [a, b, c], 0, n_vertices),
            TETRAHEDRON => push_element(&mut self.elements.tets, [a, b, c, d], 0, n_vertices),
            _ => Ok(()),
        }
    }
}

/// Returns the number of nodes of an element; known are triangles, tetrahedra, points, and lines of any order.
fn n_nodes(element_type: i32) -> Option<usize> {
    Some(match element_type {
        15 => 1,
        1 => 2,
        TRIANGLE | 8 => 3,
        TETRAHEDRON | 26 => 4,
        27 => 5,
        28 => 6,
        _ => return None,
    })
}

/// Returns the text of the elements in version 2.2, which more programs read than 4.1; triangles before tetrahedra.
pub fn write(elements: &Elements) -> String {
    let n_vertices = elements.vertices.len();
    let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{n_vertices}\n");
    for (k, [x, y, z]) in elements.vertices.iter().enumerate() {
        let _ = writeln!(text, "{} {x:?} {y:?} {z:?}", k + 1); // writing to a string cannot fail
    }
    let n_elements = elements.triangles.len() + elements.tets.len();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{n_elements}");
    let mut tag = 0;
    let mut line = |element_type: i32, corners: &[u32]| {
        tag += 1;
        let _ = write!(text, "{tag} {element_type} 2 0 1");
        for &corner in corners {
            let _ = write!(text, " {}", u64::from(corner) + 1);
        }
        text.push('\n');
    };
    for triangle in &elements.triangles {
        line(TRIANGLE, triangle);
    }
    for tet in &elements.tets {
        line(TETRAHEDRON, tet);
    }
    text.push_str("$EndElements\n");
    text
}
