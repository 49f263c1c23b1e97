//! Possible references of unknown extensions.
use super::json::as_unsigned;
use serde_json::Value;
use std::collections::BTreeSet;

/// Extensions without references to any of the collections, except in texture infos.
const PLAIN: [&str; 8] = [
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
    "KHR_node_visibility",
    "EXT_mesh_features",
    "MSFT_lod",
];

/// Returns whether [`visit`](super::links::visit) finds all references of an extension.
fn is_understood(name: &str) -> bool {
    const NAMING: [&str; 11] = [
        "KHR_draco_mesh_compression",
        "EXT_mesh_gpu_instancing",
        "CESIUM_primitive_outline",
        "EXT_mesh_manifold",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "EXT_texture_avif",
        "MSFT_texture_dds",
        "EXT_lights_image_based",
        "EXT_structural_metadata",
        "EXT_meshopt_compression",
    ];
    name.starts_with("KHR_materials_")
        || name == "KHR_meshopt_compression"
        || PLAIN.contains(&name)
        || NAMING.contains(&name)
}

/// Possible references of unknown extensions.
#[derive(Default)]
pub(super) struct Unknown {
    /// All whole numbers in them: each may be the index of anything.
    pub numbers: BTreeSet<usize>,
    /// `true` if they have a member `buffer`, and so may refer to places in the binary data.
    pub buffers: bool,
}

impl Unknown {
    pub fn of(json: &Value) -> Self {
        let mut unknown = Self::default();
        unknown.search(json, false);
        unknown
    }

    fn search(&mut self, value: &Value, is_inside: bool) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| self.search(item, is_inside)),
            Value::Object(members) => {
                for (key, child) in members {
                    self.buffers |= is_inside && key == "buffer";
                    match child {
                        _ if key == "extras" => {}
                        Value::Object(extensions) if key == "extensions" => {
                            for (name, extension) in extensions {
                                self.search(extension, is_inside || !is_understood(name));
                            }
                        }
                        _ => self.search(child, is_inside),
                    }
                }
            }
            number if is_inside => self.numbers.extend(as_unsigned(number)),
            _ => {}
        }
    }
}
