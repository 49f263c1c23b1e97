use std::collections::BTreeMap;

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

    /// The extension of the main file in lower case, without the dot; empty where there is none.
    pub fn extension(&self) -> String {
        let name = self.name.rsplit(['/', '\\']).next().unwrap_or_default();
        name.rsplit_once('.')
            .map(|(_, extension)| extension.to_ascii_lowercase())
            .unwrap_or_default()
    }
}
