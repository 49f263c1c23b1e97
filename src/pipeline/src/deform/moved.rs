//! Documents with moved surfaces and everything else unchanged.

use crate::PipelineError;
use unwrapd_files::document::{
    Document, DocumentError, Layout, NewUvs, OutputFormat, SpaceMap, WriteOptions, Written,
};

/// Applies a map to a document. Returns the document, and its files under the name `stem`.
pub fn moved(
    document: &Document,
    map: &dyn SpaceMap,
    format: OutputFormat,
    stem: &str,
) -> Result<(Document, Written), DocumentError> {
    let moved = document.clone().moved(map)?;
    let options = WriteOptions {
        format,
        stem: stem.to_owned(),
        texcoord: None,
        overwrite: false,
        terms: None,
    };
    let no_uvs = NewUvs {
        layout: Layout::Edited,
        pages: 1,
        v_axis: moved.v_axis(),
        corners: vec![None; moved.primitives().len()],
    };
    let written = moved.write(&no_uvs, &options)?;
    Ok((moved, written))
}

/// Returns the main file of the moved document; empty if it cannot be written, since its result will be rejected,
/// too.
pub fn moved_frame(document: &Document, map: &dyn SpaceMap, format: OutputFormat) -> Vec<u8> {
    let files = moved(document, map, format, "frame").map(|(_, written)| written.files);
    let main = files.ok().and_then(|files| files.into_iter().next());
    main.map_or(Vec::new(), |(_, bytes)| bytes)
}

/// Rejects frames in a format whose files refer to others.
pub fn check_frames(format: OutputFormat) -> Result<(), PipelineError> {
    if format == OutputFormat::Gltf {
        let text = "`frames` are one file each: glb or obj, not gltf".to_owned();
        return Err(PipelineError::InvalidOptions(text));
    }
    Ok(())
}

/// Rejects formats that would lose UVs and materials.
pub fn check_format(document: &Document, format: OutputFormat) -> Result<(), DocumentError> {
    let lost = match (document, format) {
        (Document::Gltf(_), OutputFormat::Obj) => "a deformed glTF document as OBJ",
        (Document::Obj(_), OutputFormat::Glb | OutputFormat::Gltf) => "a deformed OBJ file as glTF",
        _ => return Ok(()),
    };
    Err(DocumentError::UnsupportedOutput(lost.to_owned()))
}
