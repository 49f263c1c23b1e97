//! Plane geometry of many pieces, for the makers of maps.
//!
//! Which faces of a map overlap, whether its boundary is simple, how near charts come to each
//! other: code that makes UVs asks this in every round and steers by the answers. Candidates come from a
//! [`BoxIndex`], a packed Hilbert R-tree; the answers are exact, but for distances, which are
//! rounded.
//!
//! Nothing here is proof. What is written is judged by [`certificate`](crate::certificate), which
//! has its own boxes, trees and tests and imports none of this, so that a fault here is found
//! there.

mod apart;
mod box_index;
mod polygons;
mod segments;
mod straightness;
mod triangles;

pub use apart::keep_apart;
pub use box_index::{BoxIndex, Visit, search_budget};
pub use polygons::{doubled_polygon_area, meeting_point};
pub use segments::{Segment, segment_distance};
pub use straightness::Straightness;
pub use triangles::{are_disjoint, interiors_intersect, overlapping_pairs};
