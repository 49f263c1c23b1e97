//! Pictures of material files, among the supplied files.
use super::super::gltf::normalized;
use std::collections::{BTreeMap, BTreeSet};

/// Files of an upload.
pub(in crate::document) struct Pictures<'a> {
    resources: &'a BTreeMap<String, Vec<u8>>,
    /// Paths of pictures that were not supplied.
    pub missing: BTreeSet<String>,
}

impl<'a> Pictures<'a> {
    /// Searches among the files of an upload.
    pub fn among(resources: &'a BTreeMap<String, Vec<u8>>) -> Self {
        Self {
            resources,
            missing: BTreeSet::new(),
        }
    }

    /// Returns name and content of a picture named by a material file in `folder`.
    pub fn find(&mut self, folder: &str, path: &str) -> Option<(&'a str, &'a [u8])> {
        let resources = self.resources;
        let found = Self::candidates(folder, path)
            .find_map(|name| resources.get_key_value(&name))
            .map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
        if found.is_none() {
            let shown = path.chars().filter(|c| !c.is_control()).take(120);
            self.missing.insert(shown.collect());
        }
        found
    }

    /// Iterates over the possible meanings of a path: relative to the material file, to the main file, or, as absolute
    /// paths belong to another machine, a file of that name in the folder of one of them. None leaves the main file's
    /// folder.
    pub fn candidates(folder: &str, path: &str) -> impl Iterator<Item = String> {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let within =
            |path: &str| format!("{folder}{}{path}", if folder.is_empty() { "" } else { "/" });
        let paths = [within(path), path.to_owned(), within(name), name.to_owned()];
        let is_absolute = path.starts_with(['/', '\\']) || path.contains(':');
        let paths = paths.into_iter().skip(if is_absolute { 2 } else { 0 });
        paths.filter_map(|path| normalized(&path).filter(|path| !path.is_empty()))
    }
}
