//! The table of file formats: their names, how their content is known, and what it holds.
//!
//! Everything that asks what format a file has asks here. A new format is a reader or writer and a
//! row of the table.
mod signature;
mod table;

use signature::{Head, Known};
use table::{ROWS, Row};

/// How much of a file is searched for the words of its format.
pub const SEARCHED_BYTES: usize = 1 << 20;

/// The formats of files that are read or written.
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
    /// Counts, positions, corners of tetrahedra.
    Tet,
    /// VTK XML: written, not read.
    Vtu,
    /// PNG pictures.
    Png,
    /// JPEG pictures.
    Jpeg,
    /// Drawings.
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
    /// Positions, one per line.
    Txt,
    /// Tables.
    Csv,
}

/// What a file is read for.
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
    /// An image that a glTF document names; most are passed on unread.
    Texture,
}

impl Format {
    /// The format that the extension of a file's name stands for.
    pub fn of_name(name: &str) -> Option<Self> {
        let extension = extension(name);
        let mut rows = ROWS.iter();
        let row = rows.find(|row| row.extensions.contains(&extension.as_str()));
        row.map(|row| row.format)
    }

    /// The format of a file that is read for `content`, by its first bytes, of which
    /// [`SEARCHED_BYTES`] suffice, and its size.
    pub fn of_content(head: &[u8], size: u64, content: Content) -> Option<Self> {
        Self::by_signature(head, size, content)
            .or_else(|| Self::by_resemblance(head, size, content))
    }

    /// The format of a file that is read for `content`: by its first bytes where they tell, else
    /// by the extension of its name.
    pub fn detect(name: &str, bytes: &[u8], content: Content) -> Option<Self> {
        let size = bytes.len() as u64;
        let head = &bytes[..bytes.len().min(SEARCHED_BYTES)];
        Self::by_signature(head, size, content)
            .or_else(|| Self::of_name(name).filter(|format| format.holds(content)))
            .or_else(|| Self::by_resemblance(head, size, content))
    }

    fn by_signature(head: &[u8], size: u64, content: Content) -> Option<Self> {
        let head = Head { bytes: head, size };
        let is_it = |format: &Self| matches!(format.row().known, Known::Signature(is) if is(&head));
        Self::that_hold(content).find(is_it)
    }

    fn by_resemblance(head: &[u8], size: u64, content: Content) -> Option<Self> {
        let head = Head { bytes: head, size };
        let is_it =
            |format: &Self| matches!(format.row().known, Known::Resemblance(is) if is(&head));
        Self::that_hold(content).find(is_it)
    }

    /// All formats.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().map(|row| row.format)
    }

    /// The formats that are read for `content`.
    pub fn that_hold(content: Content) -> impl Iterator<Item = Self> {
        Self::all().filter(move |format| format.holds(content))
    }

    /// Whether files of this format are read for `content`.
    pub fn holds(self, content: Content) -> bool {
        self.row().contents.contains(&content)
    }

    /// The extension that files of this format are written with.
    pub fn extension(self) -> &'static str {
        self.extensions()[0]
    }

    /// All its extensions, in lower case and without the dot.
    pub fn extensions(self) -> &'static [&'static str] {
        self.row().extensions
    }

    /// Its media types, the usual one first; none where it has none.
    pub fn media_types(self) -> &'static [&'static str] {
        self.row().media_types
    }

    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}

/// The extension of a file's name or path in lower case, without the dot; empty where there is none.
pub fn extension(path: &str) -> String {
    let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
    let extension = name.rsplit_once('.').map(|(_, extension)| extension);
    extension.unwrap_or_default().to_ascii_lowercase()
}

/// Text without the byte order mark that some editors put before it.
pub fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}
