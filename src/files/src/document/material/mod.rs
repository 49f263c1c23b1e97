//! Materials between formats: the common content of MTL, with its extension for physically based shading, and glTF.
//!
//! Colors are transferred without a conversion, as in Blender and obj2gltf. Without an MTL roughness, it follows from
//! `Ns` as in Blender, so that Blender's own files round-trip: r = 1 − √(Ns / 1000). `Ks` ½ is the reflection of 4 %
//! that glTF assumes for everything, so that `specularColorFactor` is twice `Ks`.
//!
//! MTL is read without a library: the available one (`tobj`) knows neither options of maps nor the extension, and stops
//! at the first number that it cannot read.
mod gltf;
mod map;
mod mtl;

pub(super) use gltf::{GltfMaterials, material as of_gltf};
pub(super) use map::{TextureMap, UploadedPictures};
pub(super) use mtl::{Dropped, MaterialFiles, mtl_text};

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Material {
    pub name: String,
    pub color: [f64; 3],
    pub alpha: f64,
    pub color_map: Option<TextureMap>,
    /// `true` if the alpha of `color_map` counts.
    pub is_cut_out: bool,
    pub metallic: f64,
    pub roughness: f64,
    /// Roughness in green, metalness in blue.
    pub metallic_roughness_map: Option<TextureMap>,
    /// `Ks`; ½ by default.
    pub specular: [f64; 3],
    pub ior: f64,
    pub emission: [f64; 3],
    pub emission_map: Option<TextureMap>,
    pub normal_map: Option<TextureMap>,
    /// `true` if `normal_map` is called a bump map, which may also mean one of heights.
    pub is_bump: bool,
    /// Strength and roughness of a coat.
    pub coat: [f64; 2],
    /// `true` if it shows its color independent of the light.
    pub is_unlit: bool,
}

impl Material {
    /// Creates a material with the defaults of glTF, except that it is not a metal.
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
