//! The sections of a file, in the framings of both versions.

use super::super::cursor::{Cursor, Encoding};
use super::super::elements::{Elements, push_element};
use super::super::{ReadError, position};
use super::{TETRAHEDRON, TRIANGLE};
use std::collections::HashMap;

/// Nodes and elements of a file read so far.
pub(super) struct Reader<'a> {
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
            let is_text = self.cursor.encoding == Encoding::Text;
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
        if self.cursor.encoding != Encoding::Text {
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
