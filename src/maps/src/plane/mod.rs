//! Plane geometry of many pieces, for the code that makes maps.
//!
//! Code that makes UVs asks in every round which faces of a map overlap, whether its boundary is simple and how near
//! charts come to each other, and steers by the answers. Candidates come from a [`BoxIndex`], a packed Hilbert R-tree;
//! the answers are exact, except for distances, which are rounded.
//!
//! Nothing here is proof. Written maps are judged by [`certificate`](crate::certificate), which has its own boxes,
//! trees and tests and imports none from here, so that a fault here is found there.
mod box_index;
mod shapes;

pub use box_index::{BoxIndex, Visit, search_budget};
pub use shapes::{
    Segment, Straightness, are_disjoint, doubled_polygon_area, interiors_intersect, keep_apart,
    meeting_point, overlapping_pairs, segment_distance,
};
