//! What a glTF calls its meshes and materials.

use super::GltfDocument;
use crate::document::group::Names;

/// Characters of a name that are shown at most.
const SHOWN: usize = 80;

impl Names for GltfDocument {
    fn mesh(&self, index: usize) -> Option<String> {
        self.name_of("meshes", index)
    }

    fn material(&self, index: usize) -> Option<String> {
        self.name_of("materials", index)
    }
}

impl GltfDocument {
    /// A name as it can be shown on a line; `None` where there is nothing to show.
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
