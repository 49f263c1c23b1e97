//! Meshes and materials as messages call them.
use super::GltfDocument;
use std::collections::BTreeSet;

/// Names that a message lists before it counts the rest.
const MOST_LISTED: usize = 3;

/// Some of the meshes, and how many more there are.
pub(super) fn of_meshes(document: &GltfDocument, meshes: &BTreeSet<usize>) -> String {
    let names = meshes
        .iter()
        .map(|&mesh| named(document, "meshes", "mesh", mesh));
    listed(names.collect())
}

/// The name of a material, or its number.
pub(super) fn of_material(document: &GltfDocument, material: usize) -> String {
    named(document, "materials", "material", material)
}

/// Some of the names, and how many more there are.
pub(super) fn listed(names: Vec<String>) -> String {
    let n_more = names.len().saturating_sub(MOST_LISTED);
    let first = names
        .into_iter()
        .take(MOST_LISTED)
        .collect::<Vec<_>>()
        .join(", ");
    match n_more {
        0 => first,
        n => format!("{first} and {n} more"),
    }
}

fn named(document: &GltfDocument, collection: &str, kind: &str, index: usize) -> String {
    match document.body.json[collection][index]["name"].as_str() {
        Some(name) if !name.trim().is_empty() => {
            let name: String = name.chars().filter(|c| !c.is_control()).take(60).collect();
            format!("`{name}`")
        }
        _ => format!("{kind} {index}"),
    }
}
