//! The table of formats.
use super::Content::{self, Body, Picture, Problem, Surface, Texture};
use super::Format;
use super::signature::Known::{self, Name, Resemblance, Signature};
use super::signature::{
    is_glb, is_jpeg, is_ktx2, is_mesh, is_msh, is_obj, is_object, is_off, is_ply, is_png, is_stl,
    is_svg, is_tet, is_webp,
};

/// What is known of a format.
pub(super) struct Row {
    pub format: Format,
    /// Without the dot, the one that is written first.
    pub extensions: &'static [&'static str],
    /// The one that is sent first.
    pub media_types: &'static [&'static str],
    pub known: Known,
    pub contents: &'static [Content],
}

const fn row(
    format: Format,
    extensions: &'static [&'static str],
    media_types: &'static [&'static str],
    known: Known,
    contents: &'static [Content],
) -> Row {
    Row {
        format,
        extensions,
        media_types,
        known,
        contents,
    }
}

/// Media types that STL files have had.
const STL_TYPES: &[&str] = &["model/stl", "application/sla", "application/vnd.ms-pki.stl"];

/// In the order of [`Format`], in which messages list them too.
#[rustfmt::skip]
pub(super) const ROWS: [Row; 20] = [
    row(Format::Glb, &["glb"], &["model/gltf-binary"], Signature(is_glb), &[Surface, Body]),
    row(Format::Gltf, &["gltf"], &["model/gltf+json"], Signature(is_object), &[Surface, Body]),
    row(Format::Obj, &["obj"], &["model/obj"], Resemblance(is_obj), &[Surface, Body]),
    row(Format::Off, &["off"], &["model/off"], Signature(is_off), &[Surface, Body]),
    row(Format::Ply, &["ply"], &["model/ply", "application/ply"], Signature(is_ply), &[Surface, Body]),
    row(Format::Stl, &["stl"], STL_TYPES, Signature(is_stl), &[Surface, Body]),
    row(Format::Msh, &["msh"], &[], Signature(is_msh), &[Body]),
    row(Format::Mesh, &["mesh"], &[], Signature(is_mesh), &[Body]),
    row(Format::Tet, &["tet"], &[], Resemblance(is_tet), &[Body]),
    row(Format::Vtu, &["vtu"], &[], Name, &[]),
    row(Format::Png, &["png"], &["image/png"], Signature(is_png), &[Body, Picture, Texture]),
    row(Format::Jpeg, &["jpg", "jpeg"], &["image/jpeg"], Signature(is_jpeg), &[Picture, Texture]),
    row(Format::Svg, &["svg"], &["image/svg+xml"], Signature(is_svg), &[Body]),
    row(Format::Webp, &["webp"], &["image/webp"], Signature(is_webp), &[Texture]),
    row(Format::Ktx2, &["ktx2"], &["image/ktx2"], Signature(is_ktx2), &[Texture]),
    row(Format::Avif, &["avif"], &["image/avif"], Name, &[Texture]),
    row(Format::Dds, &["dds"], &["image/vnd-ms.dds"], Name, &[Texture]),
    row(Format::Json, &["json"], &["application/json"], Signature(is_object), &[Problem]),
    row(Format::Txt, &["txt"], &["text/plain"], Name, &[]),
    row(Format::Csv, &["csv"], &["text/csv"], Name, &[]),
];

const _: () = {
    let mut index = 0;
    while index < ROWS.len() {
        assert!(ROWS[index].format as usize == index);
        index += 1;
    }
};
