//! Drawings of UV layouts and their distortion; pictures with transparency, and pictures deformed with a mesh.
//!
//! A drawing has the orientation of the texture: if all UVs are inside the unit square, the picture is that square, and
//! each pixel is a texel of a texture of the same size. Faces are filled by supersampling with half-open scan
//! conversion, so a sample on a common edge belongs to one face, and samples covered twice are real overlaps. Edges of
//! faces are drawn where faces are large enough to show them, the borders of charts always. Equal input gives equal
//! bytes.
mod canvas;
mod heat;
mod image;
mod ktx2;
mod panel;
mod raster;
mod warp;

pub use heat::{HeatmapMeasure, heatmap_png};
pub use image::{Image, ImageError, Picture, picture_size, thumbnail_png};
pub use panel::{Panel, layout_png};
pub(crate) use raster::{spans, steps};
pub use warp::{Deformation, Extent, Warped, warped};
