//! Textures resampled from one UV map of a surface to another.
//!
//! A texture lies on a surface by a UV map. After the surface got another map, the same look needs another texture: each
//! texel of it takes the color that the surface had at that place. [`Coverage`] tells once per atlas which face each
//! texel belongs to; [`baked`] evaluates every texel once, by as many bilinear samples as texels of the source fall on
//! it, averaged in linear light. Bilinear filtering also reads texels beside a chart: those within reach take the
//! color of the chart's nearest point, so that nothing is read from across the borders of the source's charts. All
//! others are filled from their neighbors, ring by ring, so that every mip level finds a chart's own colors around it.
//!
//! What vertices have, such as colors, needs no texture to come from: [`baked_attribute`] interpolates it.
//!
//! Normal maps hold directions relative to tangents, which turn with the UVs: [`Frames`] carries each direction from the
//! old frame to the new one.
//!
//! Texel (x, y) of a texture of n × n is centered at ((x + ½)/n, (y + ½)/n) in UVs with v down, as glTF has it. Equal
//! input gives equal pictures, for any number of threads.
mod attribute;
mod color;
mod coverage;
mod fill;
mod frames;
mod plane;
mod reduced;
mod resample;
mod size;
mod texture;
mod triangle;

pub use attribute::baked_attribute;
pub use coverage::Coverage;
pub use frames::Frames;
pub use plane::{Plane, Sampled};
pub use resample::baked;
pub use size::{MOST_TEXELS, side_for};
pub use texture::Texture;

/// The corners of a face in the plane.
pub type Corners = [[f64; 2]; 3];
