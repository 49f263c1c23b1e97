//! Detection of a file's format from its first bytes.

use super::{gmsh, medit, obj, off, ply, stl, tet};
use crate::io::Elements;
use crate::io::IndexedTriangles;
use crate::io::ReadError;
use crate::io::vtu;
use unwrapd_api::{Content, Format, SEARCHED_BYTES, without_mark};

/// Returns the format of a file that is read for `content`: by its first bytes if they are characteristic, else by the
/// extension of its name.
pub fn detect(name: &str, bytes: &[u8], content: Content) -> Option<Format> {
    let head = Head {
        bytes: &bytes[..bytes.len().min(SEARCHED_BYTES)],
        size: bytes.len() as u64,
    };
    head.find(content, signature)
        .or_else(|| Format::of_name(name).filter(|format| format.holds(content)))
        .or_else(|| head.find(content, resemblance))
}

/// Returns the format of a file of `size` bytes that is read for `content`, by its first bytes; [`SEARCHED_BYTES`] are
/// enough.
pub fn format_of_content(head: &[u8], size: u64, content: Content) -> Option<Format> {
    let head = Head { bytes: head, size };
    head.find(content, signature)
        .or_else(|| head.find(content, resemblance))
}

/// Returns the test for bytes with which no other format begins; `None` if the format has no such bytes.
fn signature(format: Format) -> Option<Test> {
    match format {
        Format::Glb => Some(is_glb),
        Format::Gltf | Format::Json => Some(is_object),
        Format::Off => Some(is_off),
        Format::Ply => Some(is_ply),
        Format::Stl => Some(is_stl),
        Format::Msh => Some(is_msh),
        Format::Mesh => Some(is_mesh),
        Format::Png => Some(is_png),
        Format::Jpeg => Some(is_jpeg),
        Format::Svg => Some(is_svg),
        Format::Webp => Some(is_webp),
        Format::Ktx2 => Some(is_ktx2),
        _ => None,
    }
}

/// Returns the test for text that is usual in files of a format, for files without a telling name.
fn resemblance(format: Format) -> Option<Test> {
    match format {
        Format::Obj => Some(is_obj),
        Format::Tet => Some(is_tet),
        _ => None,
    }
}

/// Test whether the first bytes of a file look like those of a format.
type Test = fn(&Head) -> bool;

/// The beginning of a file.
struct Head<'a> {
    bytes: &'a [u8],
    /// Size of the whole file, in bytes.
    size: u64,
}

impl<'a> Head<'a> {
    /// Returns the first format for `content` whose test the file passes.
    fn find(&self, content: Content, test: fn(Format) -> Option<Test>) -> Option<Format> {
        Format::that_hold(content).find(|&format| test(format).is_some_and(|is_it| is_it(self)))
    }

    /// Returns the text without a byte order mark and leading blanks.
    fn text(&self) -> &'a [u8] {
        without_mark(self.bytes).trim_ascii_start()
    }
}

fn is_glb(head: &Head) -> bool {
    head.bytes.starts_with(b"glTF")
}

fn is_object(head: &Head) -> bool {
    head.text().starts_with(b"{")
}

fn is_obj(head: &Head) -> bool {
    obj::has_vertex(head.text())
}

fn is_off(head: &Head) -> bool {
    off::has_header(head.text())
}

fn is_ply(head: &Head) -> bool {
    ply::has_header(head.bytes)
}

fn is_stl(head: &Head) -> bool {
    stl::is_binary(head.bytes, head.size) || stl::is_text(head.bytes)
}

fn is_msh(head: &Head) -> bool {
    gmsh::has_header(head.text())
}

fn is_mesh(head: &Head) -> bool {
    medit::has_header(head.text())
}

fn is_tet(head: &Head) -> bool {
    tet::has_counts(head.text())
}

fn is_png(head: &Head) -> bool {
    head.bytes.starts_with(b"\x89PNG")
}

fn is_jpeg(head: &Head) -> bool {
    head.bytes.starts_with(b"\xFF\xD8\xFF")
}

fn is_svg(head: &Head) -> bool {
    let text = head.text();
    text.starts_with(b"<") && text.windows(4).any(|word| word == b"<svg")
}

fn is_webp(head: &Head) -> bool {
    head.bytes.starts_with(b"RIFF") && head.bytes.get(8..12) == Some(b"WEBP")
}

fn is_ktx2(head: &Head) -> bool {
    head.bytes.starts_with(b"\xABKTX 20")
}

// Formats of meshes to deform.

/// Formats in which meshes to deform are read and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementFormat {
    /// Gmsh `.msh`.
    Gmsh,
    /// Medit `.mesh`.
    Medit,
    /// `.tet`: counts, positions, corners.
    Tet,
    /// Wavefront OBJ: triangles only.
    Obj,
    /// Geomview OFF: triangles only.
    Off,
    /// VTK XML `.vtu`: written, not read.
    Vtu,
}

impl ElementFormat {
    /// Returns the format for the extension of a file's name.
    pub fn of_name(name: &str) -> Option<Self> {
        Format::of_name(name).and_then(Self::of)
    }

    /// Converts a general format; `None` if it is not one of these.
    pub fn of(format: Format) -> Option<Self> {
        Some(match format {
            Format::Msh => Self::Gmsh,
            Format::Mesh => Self::Medit,
            Format::Tet => Self::Tet,
            Format::Obj => Self::Obj,
            Format::Off => Self::Off,
            Format::Vtu => Self::Vtu,
            _ => return None,
        })
    }

    /// Reads a file; `.vtu` is not read.
    pub fn read(self, bytes: &[u8]) -> Result<Elements, ReadError> {
        let triangles = |mesh: IndexedTriangles<f64>| Elements {
            vertices: mesh.positions,
            triangles: mesh.triangles,
            tets: Vec::new(),
        };
        match self {
            Self::Gmsh => gmsh::read(bytes),
            Self::Medit => medit::read(bytes),
            Self::Tet => tet::read(bytes),
            Self::Obj => obj::read_as(bytes).map(|obj| triangles(obj.mesh)),
            Self::Off => off::read_as(bytes).map(triangles),
            Self::Vtu => Err(ReadError::Malformed {
                format: "VTU",
                place: "byte",
                at: 0,
                cause: "this format can be written but not read",
            }),
        }
    }

    /// Returns the text of a file. Numbers are the shortest that read back as the same `f64`. OBJ and OFF hold only the
    /// [surface](Elements::surface).
    pub fn write(self, elements: &Elements) -> String {
        match self {
            Self::Gmsh => gmsh::write(elements),
            Self::Medit => medit::write(elements),
            Self::Tet => tet::write(elements),
            Self::Obj => obj::write(elements),
            Self::Off => off::write(elements),
            Self::Vtu => vtu::write(elements, &[]),
        }
    }
}
