//! Option values that are words: the same in the command line, HTTP and reports.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::DeserializeOwned;
use serde_json::Value;

pub(super) const ENERGIES: &[&str] = &["arap", "lscm", "symmetric-dirichlet"];
pub(super) const DEFORMATIONS: &[&str] = &[
    "arap",
    "green",
    "dirichlet",
    "laplacian",
    "uniform-laplacian",
    "lscm",
    "symmetric-dirichlet",
    "mips",
    "amips",
    "st-venant-kirchhoff",
    "neo-hookean",
];
pub(super) const BARRIERS: &[&str] = &[
    "inverse-spline",
    "augmented-log",
    "log",
    "neo-hookean",
    "none",
];
pub(super) const BOUNDARIES: &[&str] = &["free", "fixed"];
pub(super) const UV_RESTS: &[&str] = &["present", "surface"];
pub(super) const METHODS: &[&str] = &["projected", "levenberg"];
pub(super) const FORMATS: &[&str] = &["glb", "gltf", "obj"];
pub(super) const BODY_FORMATS: &[&str] = &[
    "txt", "obj", "off", "msh", "mesh", "tet", "vtu", "glb", "gltf",
];
pub(super) const CUTS: &[&str] = &["auto", "fast", "disk", "keep", "seams"];
pub(super) const PRESETS: &[&str] = &["material", "lightmap"];
pub(super) const PACKINGS: &[&str] = &["fast", "tight"];
pub(super) const QUALITIES: &[&str] = &["smooth", "balanced", "few"];
pub(super) const GROUPS: &[&str] = &["mesh", "scene", "material", "primitive"];
pub(super) const IMAGE_FORMATS: &[&str] = &["source", "png", "jpeg"];
pub(super) const HEATMAPS: &[&str] = &["conformal", "area", "symmetric-dirichlet"];

/// A parser of one of `words` into the enum that serde reads from it.
pub(super) fn word<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    words: &'static [&'static str],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(words)
        .try_map(|word| serde_json::from_value::<T>(Value::String(word)))
}
