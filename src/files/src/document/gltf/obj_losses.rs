//! Contents of a document that an OBJ file cannot hold.
use super::GltfDocument;
use super::json::{extension, items, unsigned};
use super::scene::is_in_place;
use crate::document::{DocumentError, Warning};
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Returns a warning per kind of lost content, with its count.
pub(super) fn losses(document: &GltfDocument) -> Result<Vec<Warning>, DocumentError> {
    let json = &document.body.json;
    let mut warnings = Vec::new();
    let mut lose = |n: usize, code: &'static str, what: &str| {
        if n > 0 {
            let message = format!("OBJ cannot hold {what}: {n} left out");
            warnings.push(Warning::new(code, message));
        }
    };
    // Top-level objects.
    lose(items(json, "skins")?.len(), "skins_dropped", "skins");
    lose(
        items(json, "animations")?.len(),
        "animations_dropped",
        "animations",
    );
    lose(items(json, "cameras")?.len(), "cameras_dropped", "cameras");
    let lights = extension(json, "KHR_lights_punctual");
    let lights = lights.map_or(Ok(0), |lights| items(lights, "lights").map(<[_]>::len))?;
    lose(lights, "lights_dropped", "lights");
    let variants = extension(json, "KHR_materials_variants");
    let variants = variants.map_or(Ok(0), |all| items(all, "variants").map(<[_]>::len))?;
    lose(variants, "variants_dropped", "material variants");
    // Contents of primitives.
    let counts = Counts::of(document)?;
    lose(
        counts.morphed,
        "morph_targets_dropped",
        "morph targets of primitives",
    );
    lose(
        counts.uv_sets,
        "uv_sets_dropped",
        "UV sets beyond the first",
    );
    lose(
        counts.attributes,
        "attributes_dropped",
        "further vertex attributes",
    );
    lose(
        counts.elements,
        "elements_dropped",
        "primitives without triangles",
    );
    // Placements.
    let moved = n_moved(json)?;
    if moved > 0 {
        let message = format!(
            "the OBJ file holds each mesh once, without node transforms: {moved} appear elsewhere or repeatedly in the scene"
        );
        warnings.push(Warning::new("transforms_lost", message));
    }
    Ok(warnings)
}

#[derive(Default)]
struct Counts {
    morphed: usize,
    uv_sets: usize,
    attributes: usize,
    elements: usize,
}

impl Counts {
    fn of(document: &GltfDocument) -> Result<Self, DocumentError> {
        let mut counts = Self::default();
        let mut n_primitives = 0;
        for mesh in items(&document.body.json, "meshes")? {
            n_primitives += items(mesh, "primitives")?.len();
        }
        counts.elements = n_primitives - document.primitives.len();
        for primitive in &document.primitives {
            let object = document.object(primitive)?;
            counts.morphed += items(object, "targets")?.len();
            let attributes = object["attributes"].as_object();
            for name in attributes.into_iter().flat_map(Map::keys) {
                match name.as_str() {
                    // Skins are counted themselves, and tangents follow from UVs.
                    "POSITION" | "NORMAL" | "TANGENT" | "TEXCOORD_0" | "COLOR_0" => {}
                    name if name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") => {}
                    name if name.starts_with("TEXCOORD_") => counts.uv_sets += 1,
                    _ => counts.attributes += 1,
                }
            }
        }
        Ok(counts)
    }
}

/// Counts the meshes that the scene shows elsewhere than in their own placement, or more than once.
fn n_moved(json: &Value) -> Result<usize, DocumentError> {
    let in_place = is_in_place(json)?;
    let mut moved: BTreeSet<usize> = (0..in_place.len())
        .filter(|&mesh| !in_place[mesh])
        .collect();
    let mut shown = BTreeSet::new();
    for node in items(json, "nodes")? {
        let Some(mesh) = unsigned(node, "mesh")? else {
            continue;
        };
        if !shown.insert(mesh) || extension(node, "EXT_mesh_gpu_instancing").is_some() {
            moved.insert(mesh);
        }
    }
    Ok(moved.len())
}
