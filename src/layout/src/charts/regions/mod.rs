//! Nearly flat regions of a surface: facets that are merged as long as their normals lie within a
//! cone, with borders that are evened out.

mod cone;
pub(super) mod facets;
mod merge;
mod smooth;
pub(super) mod within_cones;
