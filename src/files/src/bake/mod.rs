//! Resampling of textures from one UV map of a surface to another.
//!
//! A UV map places a texture on a surface. If the surface gets another map, the same look needs another texture: each
//! of its texels gets the color that the surface had at that place. [`Coverage`] computes once per atlas which face
//! each texel belongs to; [`baked`] evaluates every texel once, with one bilinear sample per source texel that it
//! covers, averaged in linear light. Bilinear filtering also reads texels beside a chart: those within reach get the
//! color of the chart's nearest point, so that nothing is read from across the borders of the source's charts. All
//! others are filled from their neighbors, ring by ring, so that every mip level has a chart's own colors around it.
//!
//! An island that has moved by whole texels, quarter turns and flips is not resampled: its texels, and those beside it
//! within reach, are copied.
//!
//! Vertex colors multiply the texels of a plane, whose texture may be plain white. Other vertex attributes need no plane:
//! [`baked_attribute`] interpolates them.
//!
//! Islands that lie on each other share texels. [`stacks_agree`] tells whether they did so before: only then can one
//! texture show all of them.
//!
//! Normal maps hold directions relative to tangents, which turn with the UVs: [`Frames`] converts each direction from
//! the old frame to the new one.
//!
//! Texel (x, y) of a texture of n × n is centered at ((x + ½)/n, (y + ½)/n) in UVs with v down, as in glTF. Equal input
//! gives equal pictures, for any number of threads.
mod coverage;
mod moves;
mod plane;
mod resample;
mod stacks;
mod texture;

pub use coverage::Coverage;
pub use plane::{CornerColors, Frames, MOST_TEXELS, Plane, Sampled, side_for, side_of_length};
pub use resample::{baked, baked_attribute};
pub use stacks::stacks_agree;
pub use texture::{Channel, Texture};

/// Corners of a face in the plane.
pub type Corners = [[f64; 2]; 3];
