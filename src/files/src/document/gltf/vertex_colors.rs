//! Choice of the vertex colors that are drawn into textures.
//!
//! A renderer multiplies the base color of a surface by its vertex colors. Drawn into the base-color texture of every
//! material that the surface can have, they are no longer needed as an attribute.

use super::document::{COLOR, GltfDocument};
use super::json::{extension, item, items, unsigned};
use super::slots::{BASE_COLOR, Slot};
use super::textures::materials;
use crate::document::DocumentError;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Extension whose model has another texture of colors.
const SPECULAR_GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";

/// Vertex colors of primitives, by their indices.
#[derive(Default)]
pub(super) struct VertexColors {
    /// Primitives whose colors are drawn.
    pub drawn: BTreeSet<usize>,
    /// Primitives whose colors stay, with the reason.
    pub kept: BTreeMap<usize, String>,
}

impl VertexColors {
    /// Chooses among some primitives, given the textures of their materials.
    pub fn of(
        document: &GltfDocument,
        primitives: &[usize],
        slots: &BTreeMap<usize, Vec<Slot>>,
    ) -> Result<Self, DocumentError> {
        let mut colors = Self::default();
        for &index in primitives {
            let object = document.object(&document.primitives[index])?;
            if object["attributes"].get(COLOR).is_none() {
                continue;
            }
            match obstacle(document, index, object, slots)? {
                Some(reason) => drop(colors.kept.insert(index, reason)),
                None => drop(colors.drawn.insert(index)),
            }
        }
        Ok(colors)
    }
}

/// Returns the reason why the colors of a primitive must stay.
fn obstacle(
    document: &GltfDocument,
    index: usize,
    object: &Value,
    slots: &BTreeMap<usize, Vec<Slot>>,
) -> Result<Option<String>, DocumentError> {
    let reason = |text: &str| Ok(Some(text.to_owned()));
    // The attribute itself.
    let attributes = &object["attributes"];
    if document.vertex_colors(index)?.is_none() {
        return reason("they are neither RGB nor RGBA");
    }
    if attributes.get("COLOR_1").is_some() {
        return reason("the surface has further colors, which need the first ones");
    }
    let is_morphed = |target: &Value| target.get(COLOR).is_some();
    if items(object, "targets")?.iter().any(is_morphed) {
        return reason("morph targets change them");
    }
    // The textures that they would be drawn into.
    for material in materials(unsigned(object, "material")?, object)? {
        let json = item(&document.body.json, "materials", material)?;
        if extension(json, SPECULAR_GLOSSINESS).is_some() {
            return reason("the material has the specular-glossiness model");
        }
        let slots = slots.get(&material).into_iter().flatten();
        let base = slots.filter(|slot| slot.texture.slot == BASE_COLOR);
        for slot in base {
            if let Err(why) = &slot.resampled {
                return Ok(Some(format!("the texture is not resampled: {why}")));
            }
        }
    }
    Ok(None)
}
