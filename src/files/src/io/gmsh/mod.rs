//! Gmsh `.msh` of versions 2.2 and 4.1, text and binary.
//!
//! Nodes, triangles and tetrahedra are read; points and lines, which describe boundaries, and all other sections are
//! skipped. Elements of other shapes or higher order are refused, as the mesh would have holes or missing corners
//! without them. Read without a library: of the available crates `mshio` (last release 2020) reads only 4.1, `msh-rw`
//! and `rutile` (2020, 2021) call themselves unfinished; the two versions share everything except their framing.
mod reader;
mod writer;

use super::ReadError;
use super::cursor::{Cursor, Encoding};
use super::elements::Elements;
use reader::Reader;
pub use writer::write;

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
        cursor.encoding = Encoding::LittleEndian;
        cursor.encoding = match cursor.int()? {
            1 => Encoding::LittleEndian,
            0x0100_0000 => Encoding::BigEndian,
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
