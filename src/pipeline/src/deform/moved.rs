//! Documents with their surfaces where a map carries them, everything else as it was.

use crate::PipelineError;
use unwrapd_files::document::{
    Document, DocumentError, Layout, NewUvs, OutputFormat, SpaceMap, WriteOptions, Written,
};

/// The document moved, and its files under the name `stem`.
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

/// The main file of the document moved; empty if there is none, as then its result is refused too.
pub fn moved_frame(document: &Document, map: &dyn SpaceMap, format: OutputFormat) -> Vec<u8> {
    let files = moved(document, map, format, "frame").map(|(_, written)| written.files);
    let main = files.ok().and_then(|files| files.into_iter().next());
    main.map_or(Vec::new(), |(_, bytes)| bytes)
}

/// Refuses frames in a format whose files refer to others.
pub fn check_frames(format: OutputFormat) -> Result<(), PipelineError> {
    if format == OutputFormat::Gltf {
        let text = "`frames` are one file each: glb or obj, not gltf".to_owned();
        return Err(PipelineError::InvalidOptions(text));
    }
    Ok(())
}

/// Refuses formats that lose UVs and materials.
pub fn check_format(document: &Document, format: OutputFormat) -> Result<(), DocumentError> {
    let lost = match (document, format) {
        (Document::Gltf(_), OutputFormat::Obj) => "a deformed glTF document as OBJ",
        (Document::Obj(_), OutputFormat::Glb | OutputFormat::Gltf) => "a deformed OBJ file as glTF",
        _ => return Ok(()),
    };
    Err(DocumentError::UnsupportedOutput(lost.to_owned()))
}
