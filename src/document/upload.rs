use super::obj::is_obj;
use super::{gltf, obj_materials};
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

    /// Paths that the main file, and the material files among the others, may refer to: those of buffers, images, material files
    /// and their pictures. None is absolute or climbs out of the folder.
    pub fn references(&self) -> BTreeSet<String> {
        if gltf::is_gltf(self) {
            return gltf::references(&self.bytes).into_iter().collect();
        }
        if !is_obj(self) {
            return BTreeSet::new();
        }
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

    /// The extension of the main file in lower case, without the dot; empty where there is none.
    pub fn extension(&self) -> String {
        let name = self.name.rsplit(['/', '\\']).next().unwrap_or_default();
        name.rsplit_once('.')
            .map(|(_, extension)| extension.to_ascii_lowercase())
            .unwrap_or_default()
    }
}
