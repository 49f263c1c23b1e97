//! A file with the files that it refers to.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Name of the optional file with the initial positions of vertices: coordinates as consecutive `f64`, little-endian.
///
/// For bodies and pictures these are the vertices of the mesh, or of the mesh made for the input; for UVs, the
/// corners of each face that has UVs, in file order. Rest shapes and the places that handles name are still those of
/// the input.
pub const START: &str = "start.f64";

/// A main file and the files it may refer to.
#[derive(Debug, Clone, Default)]
pub struct Upload {
    /// File name of the main file; its extension decides if the content does not.
    pub name: String,
    /// Content of the main file.
    pub bytes: Vec<u8>,
    /// Other files by their path relative to the main file, decoded and with `/` between folders.
    pub resources: BTreeMap<String, Vec<u8>>,
}

impl Upload {
    /// Creates an upload of one file.
    pub fn single(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            name: name.into(),
            bytes,
            resources: BTreeMap::new(),
        }
    }

    /// Returns the extension of the main file in lower case, without the dot; empty if there is none.
    pub fn extension(&self) -> String {
        extension(&self.name)
    }
}

// The files of a job, as its record lists them.

/// An input file: its name in the references of the mesh, its size and its checksum.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// File name of the mesh, or the relative path by which the mesh refers to a buffer or an image.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read; `None` for files of earlier versions
    /// of the program.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// An output file of a job.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Role, which is also its path: `result`, `report`, `uvs.bin`, `files/NAME` for files that belong to the result,
    /// or the role of a [`Picture`](crate::Picture).
    pub role: String,
    /// File name for saving it.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read; `None` for files of earlier versions
    /// of the program.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// Returns the SHA-256 of some bytes in hexadecimal digits, as records store it.
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}

// The table of file formats: their names and contents. Detection by content lives with the readers.

/// Number of bytes of a file that are searched to detect its format. OBJ is recognized by its first vertex and SVG by
/// its root element; either may follow long comments.
pub const SEARCHED_BYTES: usize = 1 << 20;

/// A file format that is read or written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Binary glTF.
    Glb,
    /// glTF as JSON.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Geomview OFF, text.
    Off,
    /// Stanford PLY, text or binary.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
    /// Gmsh.
    Msh,
    /// Medit.
    Mesh,
    /// Plain text: counts, positions, corners of tetrahedra.
    Tet,
    /// VTK XML: written, not read.
    Vtu,
    /// PNG pictures.
    Png,
    /// JPEG pictures.
    Jpeg,
    /// SVG drawings.
    Svg,
    /// `WebP` pictures.
    Webp,
    /// KTX 2.0 textures.
    Ktx2,
    /// AVIF pictures.
    Avif,
    /// `DirectDraw` textures.
    Dds,
    /// Problem files and reports.
    Json,
    /// Plain text: positions, one per line.
    Txt,
    /// Tables as CSV.
    Csv,
}

/// Purpose for which a file is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// A surface, with or without a document around it.
    Surface,
    /// A body to deform: a surface, a mesh of elements, or an outline.
    Body,
    /// A picture to warp.
    Picture,
    /// A problem to solve.
    Problem,
    /// An image that a glTF document refers to; most are passed on unread.
    Texture,
}

impl Format {
    /// Returns the format for the extension of a file name.
    pub fn of_name(name: &str) -> Option<Self> {
        let extension = extension(name);
        let mut rows = ROWS.iter();
        let row = rows.find(|row| row.extensions.contains(&extension.as_str()));
        row.map(|row| row.format)
    }

    /// Iterates over all formats.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().map(|row| row.format)
    }

    /// Iterates over the formats that are read for `content`.
    pub fn that_hold(content: Content) -> impl Iterator<Item = Self> {
        Self::all().filter(move |format| format.holds(content))
    }

    /// Returns whether files of this format are read for `content`.
    pub fn holds(self, content: Content) -> bool {
        self.row().contents.contains(&content)
    }

    /// Returns the extension with which files of this format are written.
    pub fn extension(self) -> &'static str {
        self.extensions()[0]
    }

    /// Returns all its extensions, in lower case and without the dot.
    pub fn extensions(self) -> &'static [&'static str] {
        self.row().extensions
    }

    /// Returns its media types, the usual one first; empty if it has none.
    pub fn media_types(self) -> &'static [&'static str] {
        self.row().media_types
    }

    fn row(self) -> &'static FormatRow {
        &ROWS[self as usize]
    }
}

/// Returns the extension of a file name or path in lower case, without the dot; empty if there is none.
pub fn extension(path: &str) -> String {
    let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
    let extension = name.rsplit_once('.').map(|(_, extension)| extension);
    extension.unwrap_or_default().to_ascii_lowercase()
}

/// Returns a text without the byte order mark that some editors prepend.
pub fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// Properties of a format.
struct FormatRow {
    format: Format,
    /// Extensions without the dot, the one for writing first.
    extensions: &'static [&'static str],
    /// Media types, the one for sending first.
    media_types: &'static [&'static str],
    contents: &'static [Content],
}

const fn row(
    format: Format,
    extensions: &'static [&'static str],
    media_types: &'static [&'static str],
    contents: &'static [Content],
) -> FormatRow {
    FormatRow {
        format,
        extensions,
        media_types,
        contents,
    }
}

/// Media types in use for STL files.
const STL_TYPES: &[&str] = &["model/stl", "application/sla", "application/vnd.ms-pki.stl"];

/// Formats in the order of [`Format`], which is also the order in messages.
#[rustfmt::skip]
const ROWS: [FormatRow; 20] = [
    row(Format::Glb, &["glb"], &["model/gltf-binary"], &[Content::Surface, Content::Body]),
    row(Format::Gltf, &["gltf"], &["model/gltf+json"], &[Content::Surface, Content::Body]),
    row(Format::Obj, &["obj"], &["model/obj"], &[Content::Surface, Content::Body]),
    row(Format::Off, &["off"], &["model/off"], &[Content::Surface, Content::Body]),
    row(Format::Ply, &["ply"], &["model/ply", "application/ply"], &[Content::Surface, Content::Body]),
    row(Format::Stl, &["stl"], STL_TYPES, &[Content::Surface, Content::Body]),
    row(Format::Msh, &["msh"], &[], &[Content::Body]),
    row(Format::Mesh, &["mesh"], &[], &[Content::Body]),
    row(Format::Tet, &["tet"], &[], &[Content::Body]),
    row(Format::Vtu, &["vtu"], &[], &[]),
    row(Format::Png, &["png"], &["image/png"], &[Content::Body, Content::Picture, Content::Texture]),
    row(Format::Jpeg, &["jpg", "jpeg"], &["image/jpeg"], &[Content::Picture, Content::Texture]),
    row(Format::Svg, &["svg"], &["image/svg+xml"], &[Content::Body]),
    row(Format::Webp, &["webp"], &["image/webp"], &[Content::Picture, Content::Texture]),
    row(Format::Ktx2, &["ktx2"], &["image/ktx2"], &[Content::Texture]),
    row(Format::Avif, &["avif"], &["image/avif"], &[Content::Texture]),
    row(Format::Dds, &["dds"], &["image/vnd-ms.dds"], &[Content::Texture]),
    row(Format::Json, &["json"], &["application/json"], &[Content::Problem]),
    row(Format::Txt, &["txt"], &["text/plain"], &[]),
    row(Format::Csv, &["csv"], &["text/csv"], &[]),
];

const _: () = {
    let mut index = 0;
    while index < ROWS.len() {
        assert!(ROWS[index].format as usize == index);
        index += 1;
    }
};
