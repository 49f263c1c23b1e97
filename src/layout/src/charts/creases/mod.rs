//! Hard surfaces: planes cut and joined as a modeler would.
//!
//! A [hard component](hard_components::Divided) consists of [facets](super::facets), each of which lies in the
//! page as it is, and perhaps of a few curved patches. Facets with a straight border in common
//! are [joined](joined::Joining) as rigid pieces if neither covers the other, first where a seam
//! would cost most: a box becomes a cross, a cylinder a rectangle and two discs, sheet metal its
//! blank. Nothing is bent or stretched but the patches, and distortion of one never pays for another.

mod contact;
mod flat;
pub(super) mod hard_components;
mod images;
mod joined;
mod joints;
mod layout;
mod mirrored;
mod piece;
