//! Names of meshes and materials of a glTF.

use std::collections::BTreeSet;

use super::GltfDocument;
use crate::document::group::Names;
use crate::document::warning::listed;

/// Most characters of a name that are shown.
const SHOWN: usize = 80;

/// Lists some of the meshes, and the number of further ones.
pub(super) fn of_meshes(document: &GltfDocument, meshes: &BTreeSet<usize>) -> String {
    let named = |&mesh: &usize| quoted(Names::mesh(document, mesh), "mesh", mesh);
    let names: Vec<String> = meshes.iter().map(named).collect();
    listed(names.iter().map(String::as_str))
}

/// Returns the name of a material, or its number.
pub(super) fn of_material(document: &GltfDocument, material: usize) -> String {
    quoted(Names::material(document, material), "material", material)
}

fn quoted(name: Option<String>, kind: &str, index: usize) -> String {
    name.map_or_else(|| format!("{kind} {index}"), |name| format!("`{name}`"))
}

impl Names for GltfDocument {
    fn mesh(&self, index: usize) -> Option<String> {
        self.name_of("meshes", index)
    }

    fn material(&self, index: usize) -> Option<String> {
        self.name_of("materials", index)
    }
}

impl GltfDocument {
    /// Returns a name in a form that fits on a line; `None` if there is nothing to show.
    fn name_of(&self, kind: &str, index: usize) -> Option<String> {
        let name = self.body.json[kind][index]["name"].as_str()?;
        let name: String = name
            .chars()
            .filter(|c| !c.is_control())
            .take(SHOWN)
            .collect();
        let name = name.trim();
        (!name.is_empty()).then(|| name.to_owned())
    }
}
