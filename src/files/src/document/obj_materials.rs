//! Material files of an OBJ text, and their pictures.
use super::material::{MaterialFiles, Pictures};
use super::obj_parts::name_of;
use super::{Warning, warning};
use crate::io::obj::{Statement, statements};
use std::collections::{BTreeMap, BTreeSet};

/// References of an OBJ text.
#[derive(Default)]
pub(super) struct ObjMaterials {
    /// Materials that are described.
    pub files: MaterialFiles,
    /// Names of the material files that were supplied.
    supplied: BTreeSet<String>,
    /// Names of the material files that were not supplied.
    missing: BTreeSet<String>,
    /// Names of the materials in use.
    used: BTreeSet<String>,
}

impl ObjMaterials {
    /// Collects the materials of a text, with the supplied files.
    pub fn of(text: &[u8], resources: &BTreeMap<String, Vec<u8>>) -> Self {
        let mut materials = Self::default();
        for statement in named(text) {
            match statement.keyword {
                b"usemtl" => drop(materials.used.insert(name_of(&statement))),
                b"mtllib" => {
                    let words = statement.words.iter();
                    let words = words.map(|word| String::from_utf8_lossy(word).into_owned());
                    materials.add(&name_of(&statement), words.collect(), resources);
                }
                _ => {}
            }
        }
        materials
    }

    /// Adds one file whose name has blanks, or several files.
    fn add(&mut self, line: &str, words: Vec<String>, resources: &BTreeMap<String, Vec<u8>>) {
        let find = |path: &str| {
            let found = Pictures::candidates("", path).find(|name| resources.contains_key(name));
            found.map(|name| (resources[&name].as_slice(), name))
        };
        let paths = match find(line) {
            Some(_) => vec![line.to_owned()],
            None => words,
        };
        for path in paths {
            match find(&path) {
                Some((bytes, name)) => {
                    if self.supplied.insert(name.clone()) {
                        self.files.add(&name, bytes);
                    }
                }
                None => drop(self.missing.insert(path)),
            }
        }
    }

    /// Returns the supplied files with their pictures.
    pub fn beside(&self, resources: &BTreeMap<String, Vec<u8>>) -> Vec<(String, Vec<u8>)> {
        let mut names: Vec<&str> = self.supplied.iter().map(String::as_str).collect();
        let mut pictures = Pictures::among(resources);
        for (folder, path) in self.files.pictures() {
            names.extend(pictures.find(folder, &path).map(|(name, _)| name));
        }
        let mut known = BTreeSet::new();
        names.retain(|name| known.insert(*name));
        let file = |name: &str| (name.to_owned(), resources[name].clone());
        names.into_iter().map(file).collect()
    }

    /// Returns a warning if a material file is missing.
    pub fn warnings(&self) -> Vec<Warning> {
        if self.missing.is_empty() {
            return Vec::new();
        }
        let names = warning::listed(self.missing.iter().map(String::as_str));
        let message =
            format!("material files were not supplied, so only material names are known: {names}");
        vec![Warning::new("material_files_missing", message)]
    }

    /// Returns a warning that textures no longer fit because their UVs are replaced.
    pub fn warnings_of_new_uvs(&self) -> Option<Warning> {
        let is_textured = |name: &&str| self.files.maps_of(name).next().is_some();
        let textured: Vec<&str> = (self.used.iter().map(String::as_str))
            .filter(is_textured)
            .collect();
        if !textured.is_empty() {
            let names = warning::listed(textured.into_iter());
            let message = format!(
                "textures no longer fit because the UVs were replaced: materials {names}; to resample them, write \
                 glTF with --rebake"
            );
            return Some(Warning::new("textures_misplaced", message));
        }
        let is_unknown = self.supplied.is_empty() && !self.missing.is_empty();
        let message = "the UVs of the file were replaced, so textures made for them no longer fit";
        is_unknown.then(|| Warning::new("uvs_replaced", message))
    }
}

/// Iterates over the statements about materials and their files; others are not parsed.
fn named(text: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
    let is_named = |line: &&[u8]| {
        let line = line.trim_ascii_start();
        line.starts_with(b"usemtl") || line.starts_with(b"mtllib")
    };
    lines.filter(is_named).flat_map(statements)
}

/// Returns the possible paths of the material files of a text, relative to it.
pub(super) fn material_paths(text: &[u8]) -> BTreeSet<String> {
    let libraries = named(text).filter(|statement| statement.keyword == b"mtllib");
    let names = libraries.flat_map(|statement| {
        let words = statement.words.iter();
        let words = words.map(|word| String::from_utf8_lossy(word).into_owned());
        words.chain([name_of(&statement)]).collect::<Vec<_>>()
    });
    names
        .flat_map(|name| Pictures::candidates("", &name).collect::<Vec<_>>())
        .collect()
}

/// Returns the possible paths of the pictures of the material file at `path`, relative to the main file.
pub(super) fn picture_paths(path: &str, bytes: &[u8]) -> BTreeSet<String> {
    let mut files = MaterialFiles::default();
    files.add(path, bytes);
    let pictures = files.pictures();
    pictures
        .flat_map(|(folder, path)| Pictures::candidates(folder, &path).collect::<Vec<_>>())
        .collect()
}
