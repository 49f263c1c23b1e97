//! UV maps edited by anchors.
//!
//! Two uses, one function: [`UvEditOptions::edit`] keeps a map as it is except where anchors pull (the paper's figure
//! 16), [`UvEditOptions::texture`] aligns points of a surface with points of a texture at the least distortion of the
//! surface (figure 17). They differ in the rest shapes and in whether boundaries are fixed. Both start from the present
//! UVs and never pass through a flip. Charts with flips are untangled first, moving as few vertices as possible.
mod anchors;
mod chart;
mod edit;
mod map;
mod session;

pub use anchors::{Anchor, parse_anchors};
pub use chart::{ChartFaces, UvRest};
pub use edit::{EditedChart, EditedUvs, UvEditOptions, edit_uvs, edit_uvs_from};
pub use map::{EditError, UvMesh};
pub use session::{LiveUvs, UvSession};
