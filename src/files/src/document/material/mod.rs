//! Materials between formats: what MTL, with its extension for physically based shading, and glTF can both say.
//!
//! Colors are carried as they are, without a conversion: that is how Blender and obj2gltf read and write them. Where MTL says
//! nothing of roughness, it follows from `Ns` as in Blender, so that its own files come back as they were: r = 1 − √(Ns / 1000).
//! `Ks` ½ is the reflection of 4 % that glTF gives to everything, so that `specularColorFactor` is twice `Ks`.
//!
//! MTL is read without a library: the one at hand (`tobj`) knows neither options of maps nor the extension, and ends at the first
//! number that it cannot read.
mod map;
mod mtl;
mod mtl_text;
mod of_gltf;
mod pictures;
mod to_gltf;

pub(super) use map::Map;
pub(super) use mtl::{Dropped, MaterialFiles};
pub(super) use mtl_text::mtl_text;
pub(super) use of_gltf::material as of_gltf;
pub(super) use pictures::Pictures;
pub(super) use to_gltf::GltfMaterials;

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Material {
    pub name: String,
    pub color: [f64; 3],
    pub alpha: f64,
    pub color_map: Option<Map>,
    /// Whether the alpha of `color_map` counts.
    pub is_cut_out: bool,
    pub metallic: f64,
    pub roughness: f64,
    /// Roughness in green, metalness in blue.
    pub metallic_roughness_map: Option<Map>,
    /// `Ks`; ½ where nothing is said.
    pub specular: [f64; 3],
    pub ior: f64,
    pub emission: [f64; 3],
    pub emission_map: Option<Map>,
    pub normal_map: Option<Map>,
    /// Whether `normal_map` is called a bump map, which may also mean one of heights.
    pub is_bump: bool,
    /// Strength and roughness of a coat.
    pub coat: [f64; 2],
    /// Whether it shows its color whatever the light.
    pub is_unlit: bool,
}

impl Material {
    /// What glTF takes for granted, but no metal.
    pub fn named(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            color: [1.0; 3],
            alpha: 1.0,
            color_map: None,
            is_cut_out: false,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_map: None,
            specular: [0.5; 3],
            ior: 1.5,
            emission: [0.0; 3],
            emission_map: None,
            normal_map: None,
            is_bump: false,
            coat: [0.0; 2],
            is_unlit: false,
        }
    }
}
