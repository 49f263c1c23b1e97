//! Names of objects, materials and files in OBJ, where every character up to the end of a line may count.
use super::json::{items, unsigned};
use crate::document::DocumentError;
use serde_json::Value;
use std::collections::HashMap;

/// Names in use, regardless of case, as file names may have to differ in more than that; each with the number of
/// requests for it.
#[derive(Default)]
pub(super) struct Taken(HashMap<String, u32>);

impl Taken {
    /// Returns the name without characters that would end it or have another meaning, and with a number if it is taken.
    pub fn name(&mut self, wanted: &str) -> String {
        let plain = |c: char| {
            if c.is_control() || "#\\/:\"".contains(c) {
                '_'
            } else {
                c
            }
        };
        let words: String = wanted.trim().chars().take(200).map(plain).collect();
        let mut name = words.clone();
        let mut times = self.0.get(&words.to_lowercase()).copied().unwrap_or(0);
        while self.0.contains_key(&name.to_lowercase()) {
            times += 1;
            name = format!("{words}_{}", times + 1);
        }
        self.0.insert(words.to_lowercase(), times);
        self.0.entry(name.to_lowercase()).or_default();
        name
    }
}

/// Returns unique names of materials.
pub(super) fn material_names(json: &Value) -> Result<Vec<String>, DocumentError> {
    let mut taken = Taken::default();
    let materials = items(json, "materials")?.iter().enumerate();
    let names = materials.map(|(index, material)| {
        let name = own_name(material).map_or_else(|| format!("material{index}"), str::to_owned);
        taken.name(&name)
    });
    Ok(names.collect())
}

/// Returns unique names of meshes: that of the mesh, or of the first node that shows it.
pub(super) fn object_names(json: &Value) -> Result<Vec<String>, DocumentError> {
    let meshes = items(json, "meshes")?;
    let mut names: Vec<Option<&str>> = meshes.iter().map(own_name).collect();
    for node in items(json, "nodes")? {
        let mesh = unsigned(node, "mesh")?.and_then(|mesh| names.get_mut(mesh));
        if let Some(name) = mesh.filter(|name| name.is_none()) {
            *name = own_name(node);
        }
    }
    let mut taken = Taken::default();
    let names = names.into_iter().enumerate().map(|(index, name)| {
        let name = name.map_or_else(|| format!("mesh{index}"), str::to_owned);
        taken.name(&name)
    });
    Ok(names.collect())
}

fn own_name(object: &Value) -> Option<&str> {
    let name = object.get("name")?.as_str()?;
    (!name.trim().is_empty()).then_some(name)
}
