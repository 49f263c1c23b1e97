//! From plain arrays to an atlas: meshes are welded, cut, mapped and packed; each shape is mapped once.

pub(super) mod alike;
mod arranged;
mod candidate;
mod chart_maps;
mod clearance;
mod compact;
pub(super) mod control;
mod copies;
mod cutter;
mod divided;
mod expected_fill;
mod map;
mod objective;
mod packed;
mod packing;
pub(super) mod placed_faces;
pub(super) mod placement;
pub(super) mod plan;
pub(super) mod position_key;
pub(super) mod repeated;
mod same_shape;
pub(super) mod seams;
pub(super) mod settings;
pub(super) mod soup;
mod stacks;
pub(super) mod unwrap;
pub(super) mod whole_texels;
