//! Requirements of a document on its reader.

use super::compression;
use super::json::{extension, invalid, items, object_mut};
use crate::document::DocumentError;
use serde_json::Value;

/// Extensions of meshes, primitives, accessors and buffers that are understood, or that do not affect the shape.
const KNOWN: [&str; 10] = [
    "KHR_mesh_quantization",
    compression::DRACO,
    compression::MESHOPT[0],
    compression::MESHOPT[1],
    "KHR_materials_variants",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "CESIUM_primitive_outline",
    "KHR_xmp_json_ld",
];

/// Refuses versions other than 2.x, and unknown required extensions that are attached where they can change the
/// geometry: to buffers, buffer views, accessors, meshes or primitives. Others, on nodes, materials, lights and the
/// like, are kept unchanged.
pub(super) fn check(json: &Value) -> Result<(), DocumentError> {
    let number = |key| json.get("asset")?.get(key)?.as_str();
    let version = number("version").ok_or_else(|| invalid("`asset.version` is missing"))?;
    let demanded = number("minVersion").unwrap_or("2.0");
    if !version.starts_with("2.") || demanded != "2.0" {
        let newest = if demanded == "2.0" { version } else { demanded };
        let newest = newest.chars().filter(|c| !c.is_control()).take(20);
        return Err(DocumentError::UnsupportedVersion(newest.collect()));
    }
    for name in items(json, "extensionsRequired")? {
        let name = name
            .as_str()
            .ok_or_else(|| invalid("`extensionsRequired` holds a value that is not a string"))?;
        if !KNOWN.contains(&name) && shapes_geometry(json, name)? {
            return Err(DocumentError::UnsupportedExtension(name.to_owned()));
        }
    }
    Ok(())
}

fn shapes_geometry(json: &Value, name: &str) -> Result<bool, DocumentError> {
    for collection in ["buffers", "bufferViews", "accessors", "meshes"] {
        let objects = items(json, collection)?;
        if objects
            .iter()
            .any(|object| extension(object, name).is_some())
        {
            return Ok(true);
        }
    }
    for mesh in items(json, "meshes")? {
        let primitives = items(mesh, "primitives")?;
        if primitives
            .iter()
            .any(|object| extension(object, name).is_some())
        {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Removes from the lists of extensions each of `names` that no object of the document carries any more; returns those
/// that were listed.
pub(super) fn prune(json: &mut Value, names: &[&str]) -> Result<Vec<String>, DocumentError> {
    let mut dropped = Vec::new();
    for name in names {
        if carries(json, name) {
            continue;
        }
        for list in ["extensionsUsed", "extensionsRequired"] {
            let Some(Value::Array(listed)) = json.get_mut(list) else {
                continue;
            };
            let before = listed.len();
            listed.retain(|listed| listed != name);
            if listed.len() < before && !dropped.iter().any(|dropped| dropped == name) {
                dropped.push((*name).to_owned());
            }
            if listed.is_empty() {
                object_mut(json)?.shift_remove(list);
            }
        }
    }
    Ok(dropped)
}

/// Returns whether any object has the extension. The parser bounds the depth of the document.
fn carries(value: &Value, name: &str) -> bool {
    match value {
        Value::Array(items) => items.iter().any(|item| carries(item, name)),
        Value::Object(members) => {
            extension(value, name).is_some() || members.values().any(|member| carries(member, name))
        }
        _ => false,
    }
}
