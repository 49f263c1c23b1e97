//! Names of objects, materials and files in OBJ, where every character up to the end of a line may count.
use super::json::{items, unsigned};
use crate::document::DocumentError;
use serde_json::Value;
use std::collections::HashMap;

/// Names that are given away, whatever their case, as files may have to differ in more; each with how often it was wanted.
#[derive(Default)]
pub(super) struct Taken(HashMap<String, u32>);

impl Taken {
    /// The name without what would end it or mean something else, and with a number where another has it.
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

/// The names of materials, each its own.
pub(super) fn material_names(json: &Value) -> Result<Vec<String>, DocumentError> {
    let mut taken = Taken::default();
    let materials = items(json, "materials")?.iter().enumerate();
    let names = materials.map(|(index, material)| {
        let name = own_name(material).map_or_else(|| format!("material{index}"), str::to_owned);
        taken.name(&name)
    });
    Ok(names.collect())
}

/// The names of meshes, each its own: that of the mesh, or of the first node that shows it.
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
