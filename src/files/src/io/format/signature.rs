//! How the first bytes of a file tell its format.
use super::super::{gmsh, medit, obj, off, ply, stl, tet};
use super::without_mark;

/// Whether the first bytes of a file look like those of a format.
pub(super) type Test = fn(&Head) -> bool;

/// How a format is known.
#[derive(Clone, Copy)]
pub(super) enum Known {
    /// By bytes that no other format begins with.
    Signature(Test),
    /// By the name; if that says nothing, by text that is usual in such files.
    Resemblance(Test),
    /// By the name alone.
    Name,
}

/// The beginning of a file.
pub(super) struct Head<'a> {
    pub bytes: &'a [u8],
    /// Bytes of the whole file.
    pub size: u64,
}

impl<'a> Head<'a> {
    /// What stands there, without a byte order mark and blanks before it.
    fn text(&self) -> &'a [u8] {
        without_mark(self.bytes).trim_ascii_start()
    }
}

pub(super) fn is_glb(head: &Head) -> bool {
    head.bytes.starts_with(b"glTF")
}

pub(super) fn is_object(head: &Head) -> bool {
    head.text().starts_with(b"{")
}

pub(super) fn is_obj(head: &Head) -> bool {
    obj::has_vertex(head.text())
}

pub(super) fn is_off(head: &Head) -> bool {
    off::has_header(head.text())
}

pub(super) fn is_ply(head: &Head) -> bool {
    ply::has_header(head.bytes)
}

pub(super) fn is_stl(head: &Head) -> bool {
    stl::is_binary(head.bytes, head.size) || stl::is_text(head.bytes)
}

pub(super) fn is_msh(head: &Head) -> bool {
    gmsh::has_header(head.text())
}

pub(super) fn is_mesh(head: &Head) -> bool {
    medit::has_header(head.text())
}

pub(super) fn is_tet(head: &Head) -> bool {
    tet::has_counts(head.text())
}

pub(super) fn is_png(head: &Head) -> bool {
    head.bytes.starts_with(b"\x89PNG")
}

pub(super) fn is_jpeg(head: &Head) -> bool {
    head.bytes.starts_with(b"\xFF\xD8\xFF")
}

pub(super) fn is_svg(head: &Head) -> bool {
    let text = head.text();
    text.starts_with(b"<") && text.windows(4).any(|word| word == b"<svg")
}

pub(super) fn is_webp(head: &Head) -> bool {
    head.bytes.starts_with(b"RIFF") && head.bytes.get(8..12) == Some(b"WEBP")
}

pub(super) fn is_ktx2(head: &Head) -> bool {
    head.bytes.starts_with(b"\xABKTX 20")
}
