//! Planes of a surface: the elements of which hard surfaces are made.
//!
//! A [facet](planar::Facets) is a maximal connected set of faces that lie in one plane, found by fit: within
//! a degree and a ten-thousandth of the diagonal, so that neither the rounding of a file nor needles
//! divide it. Facets that meet at [vertices with curvature](curved_vertices) are no planes of a modeler
//! but samples of a curved [patch](patches::Patches).

mod curved_vertices;
pub(super) mod faces;
pub(super) mod patches;
pub(super) mod planar;
