//! Files to which an upload refers.

use std::collections::BTreeSet;

use super::{Upload, gltf, obj_materials};
use crate::io::{Content, Format, detect};

/// Adds the files to which an upload refers, and those to which these refer, as far as `read` finds them. Whether a
/// missing one is needed is decided when the document is read.
pub fn with_references(mut upload: Upload, read: impl Fn(&str) -> Option<Vec<u8>>) -> Upload {
    let mut tried = BTreeSet::new();
    while let new = (references(&upload))
        .difference(&tried)
        .cloned()
        .collect::<Vec<_>>()
        && !new.is_empty()
    {
        for reference in new {
            if let Some(content) = read(&reference) {
                upload.resources.insert(reference.clone(), content);
            }
            tried.insert(reference);
        }
    }
    upload
}

/// Returns the paths to which the main file, and the material files among the others, may refer: those of buffers,
/// images, material files and their pictures. None is absolute or leaves the folder.
pub fn references(upload: &Upload) -> BTreeSet<String> {
    match format_of(upload) {
        Some(Format::Glb | Format::Gltf) => gltf::references(&upload.bytes).into_iter().collect(),
        Some(Format::Obj) => references_of_obj(upload),
        _ => BTreeSet::new(),
    }
}

fn references_of_obj(upload: &Upload) -> BTreeSet<String> {
    let materials = obj_materials::material_paths(&upload.bytes);
    let supplied = (upload.resources.iter()).filter(|(path, _)| materials.contains(*path));
    let pictures: Vec<_> = supplied
        .map(|(path, bytes)| obj_materials::picture_paths(path, bytes))
        .collect();
    materials
        .into_iter()
        .chain(pictures.into_iter().flatten())
        .collect()
}

/// Returns the format of the main file as a surface: by its content, else by the extension of its name.
pub fn format_of(upload: &Upload) -> Option<Format> {
    detect(&upload.name, &upload.bytes, Content::Surface)
}
