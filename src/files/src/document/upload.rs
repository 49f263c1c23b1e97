use super::{gltf, obj_materials};
use crate::io::{Content, Format, extension};
use std::collections::{BTreeMap, BTreeSet};

/// A main file and the files it may refer to.
#[derive(Debug, Clone, Default)]
pub struct Upload {
    /// File name of the main file; its extension decides where the content does not.
    pub name: String,
    /// Content of the main file.
    pub bytes: Vec<u8>,
    /// The other files by their path relative to the main file, decoded and with `/` between folders.
    pub resources: BTreeMap<String, Vec<u8>>,
}

impl Upload {
    /// A file that refers to no other.
    pub fn single(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            name: name.into(),
            bytes,
            resources: BTreeMap::new(),
        }
    }

    /// With the files it refers to, and those that these refer to, as far as `read` finds them.
    /// Whether a missing one is needed the document knows.
    #[must_use]
    pub fn with_references(mut self, read: impl Fn(&str) -> Option<Vec<u8>>) -> Self {
        let mut tried = BTreeSet::new();
        while let new = (self.references())
            .difference(&tried)
            .cloned()
            .collect::<Vec<_>>()
            && !new.is_empty()
        {
            for reference in new {
                if let Some(content) = read(&reference) {
                    self.resources.insert(reference.clone(), content);
                }
                tried.insert(reference);
            }
        }
        self
    }

    /// Paths that the main file, and the material files among the others, may refer to: those of buffers, images, material files
    /// and their pictures. None is absolute or climbs out of the folder.
    pub fn references(&self) -> BTreeSet<String> {
        match self.format() {
            Some(Format::Glb | Format::Gltf) => gltf::references(&self.bytes).into_iter().collect(),
            Some(Format::Obj) => self.references_of_obj(),
            _ => BTreeSet::new(),
        }
    }

    fn references_of_obj(&self) -> BTreeSet<String> {
        let materials = obj_materials::material_paths(&self.bytes);
        let supplied = self
            .resources
            .iter()
            .filter(|(path, _)| materials.contains(*path));
        let pictures: Vec<_> = supplied
            .map(|(path, bytes)| obj_materials::picture_paths(path, bytes))
            .collect();
        materials
            .into_iter()
            .chain(pictures.into_iter().flatten())
            .collect()
    }

    /// The format of the main file as a surface: by its content, else by the extension of its name.
    pub fn format(&self) -> Option<Format> {
        Format::detect(&self.name, &self.bytes, Content::Surface)
    }

    /// The extension of the main file in lower case, without the dot; empty where there is none.
    pub fn extension(&self) -> String {
        extension(&self.name)
    }
}
