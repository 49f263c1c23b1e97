//! Pictures of textures as separate files next to an OBJ file.
use super::body::Body;
use super::json::{extension, item, unsigned};
use super::obj_names::Taken;
use super::textures::TRANSFORM;
use super::{images, uri};
use crate::document::material::Map;
use crate::document::{Warning, warning};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Pictures to which materials refer.
pub(super) struct ObjPictures<'a> {
    body: &'a Body,
    resources: &'a BTreeMap<String, Vec<u8>>,
    stem: &'a str,
    taken: Taken,
    /// For each image the name of its file; `None` if there is no file.
    names: BTreeMap<usize, Option<String>>,
    files: BTreeMap<String, Vec<u8>>,
    missing: BTreeSet<String>,
    n_turned: usize,
    n_without_image: usize,
}

impl<'a> ObjPictures<'a> {
    /// Starts without pictures, for a document with these resources.
    pub fn new(body: &'a Body, resources: &'a BTreeMap<String, Vec<u8>>, stem: &'a str) -> Self {
        Self {
            body,
            resources,
            stem,
            taken: Taken::default(),
            names: BTreeMap::new(),
            files: BTreeMap::new(),
            missing: BTreeSet::new(),
            n_turned: 0,
            n_without_image: 0,
        }
    }

    /// Returns the map for a texture info.
    pub fn map(&mut self, info: &Value) -> Option<Map> {
        let json = &self.body.json;
        let texture = unsigned(info, "index").ok().flatten();
        let object = texture.and_then(|texture| item(json, "textures", texture).ok());
        let image = object.and_then(|object| unsigned(object, "source").ok().flatten());
        let Some(image) = image else {
            self.n_without_image += 1;
            return None;
        };
        let mut map = Map::of(self.name(image)?);
        if let Some(transform) = extension(info, TRANSFORM) {
            let pair = |key: &str, default: f64| {
                let at = |k: usize| transform.get(key)?.get(k)?.as_f64();
                [at(0).unwrap_or(default), at(1).unwrap_or(default)]
            };
            map.scale = pair("scale", 1.0);
            let [u, v] = pair("offset", 0.0);
            // v points up here.
            map.offset = [u, 1.0 - map.scale[1] - v];
            let turn = transform.get("rotation").and_then(Value::as_f64);
            self.n_turned += usize::from(turn.is_some_and(|turn| turn != 0.0));
        }
        Some(map)
    }

    /// Returns the name of an image's file.
    fn name(&mut self, image: usize) -> Option<String> {
        if let Some(name) = self.names.get(&image) {
            return name.clone();
        }
        let name = self.new_name(image);
        self.names.insert(image, name.clone());
        name
    }

    fn new_name(&mut self, image: usize) -> Option<String> {
        let object = item(&self.body.json, "images", image).ok()?;
        let path = object
            .get("uri")
            .and_then(Value::as_str)
            .filter(|uri| !uri::is_data(uri));
        // A supplied file keeps its name; a missing one stays a reference.
        if let Some(path) = path {
            let found = uri::member(path, self.resources);
            let Some((name, bytes)) = found else {
                self.missing
                    .insert(path.chars().filter(|c| !c.is_control()).take(120).collect());
                return Some(path.replace(['\n', '\r'], ""));
            };
            // Reserve the name, so that no other file gets it.
            self.taken
                .name(name.rsplit_once('.').map_or(name, |(stem, _)| stem));
            self.files.insert(name.to_owned(), bytes.to_vec());
            return Some(name.to_owned());
        }
        // An image inside the document gets a file, named after the image or the document.
        let bytes = images::bytes(self.body, image, self.resources).ok()?;
        let given = object
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or_default();
        let given = given
            .rsplit_once('.')
            .map_or(given, |(stem, _)| stem)
            .trim();
        let wanted = if given.is_empty() {
            format!("{}_{image}", self.stem)
        } else {
            given.replace(char::is_whitespace, "_")
        };
        let name = format!(
            "{}.{}",
            self.taken.name(&wanted),
            images::file_extension(&bytes)
        );
        self.files.insert(name.clone(), bytes.into_owned());
        Some(name)
    }

    /// Returns warnings about content that could not be transferred.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if !self.missing.is_empty() {
            let names = warning::listed(self.missing.iter().map(String::as_str));
            let message = format!("images were not supplied and remain references: {names}");
            warnings.push(Warning::new("image_missing", message));
        }
        if self.n_turned > 0 {
            let n = self.n_turned;
            let message = format!("MTL cannot rotate textures: {n} lose their rotation");
            warnings.push(Warning::new("turns_dropped", message));
        }
        if self.n_without_image > 0 {
            let n = self.n_without_image;
            let message = format!("textures without a PNG or JPEG image are left out: {n}");
            warnings.push(Warning::new("textures_dropped", message));
        }
        warnings
    }

    /// Returns the files by name.
    pub fn into_files(self) -> impl Iterator<Item = (String, Vec<u8>)> {
        self.files.into_iter()
    }
}
