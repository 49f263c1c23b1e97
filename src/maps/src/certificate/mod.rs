//! Exact judgment of UVs as stored in a file.
//!
//! A map that is injective in the solver need not be after rounding, so nothing that the solver or the packer believes
//! counts here. [`certify`] takes positions, triangles and the UVs of every corner, as f64 values that hold the file's
//! numbers exactly, and derives everything again: welded vertices (equal positions), faces connected in UV space
//! (charts), their winding relative to each other, and the orientation of each by an exact predicate.
//!
//! **Independence.** Nothing is shared with the code that makes or writes UVs except the exact predicates and the types
//! and edges of meshes: boxes, trees, distances and overlaps of makers are in [`plane`](crate::plane), and a fault in
//! them is found here.
//!
//! **Charts.** Two faces with a common edge (of welded positions) belong to one chart if the UVs of both ends agree to
//! 1e-7 of the UV extent. On one page that is less than a step of the 2⁻²³ grid, so for UVs that this program writes it
//! means exactly equal; on several pages it may span one step. In other files it lets seams that differ only by
//! rounding count as one. The tolerance decides only which faces are compared: orientation and overlap have none.
//!
//! **Winding.** A file may wind neighbors inconsistently. Winding is propagated over the chart, and a face is flipped
//! if its orientation, so corrected, is not the one that carries most UV area in its chart. A mirrored chart is
//! therefore valid, a Möbius strip in one piece is not.
//!
//! **Stacks.** Charts that cover the same points may share their texels on purpose. Where a caller accepts that
//! ([`Claims::stacks`]), one chart of each stack stands for all of it, and the stacks are listed
//! ([`Certificate::stacks`]). Only equal outlines count: charts that are nearly the same overlap.
//!
//! Maps without UVs are judged by the same predicates: [`certify_planar`] judges a deformed mesh of the plane,
//! [`boundary_crossings`] its boundary alone, [`crossings()`] whether a surface in space passes through itself.
//!
//! **Pages.** UVs may lie on several pages side by side, like UDIM tiles, and texels need not be squares of UV space:
//! distances are counted in texels along both axes, and whether each chart lies on one page ([`Certificate::pages`]) is
//! a comparison of numbers.
//!
//! **Distances.** Whether charts keep a distance ([`Certificate::padding`]), and whether the map stays bijective
//! however a tool rounds it to fewer bits ([`Certificate::bits`]), is decided on the boundary edges of charts, in
//! integers. Numbers that are not multiples of 2⁻⁴⁰ are truncated to one, and the doubt counts against the map.
mod boundary;
mod box_tree;
mod claims;
mod fixed;
mod islands;
mod judgment;
mod overlap;
mod padding;
mod rounding;
mod stacks;
mod topology;

use crate::mesh::CornerUvs;
pub(crate) use boundary::{ChartBoundary, segment_distance};
pub(crate) use box_tree::BoxVisit;
pub use claims::{Claims, Overlap, Padding, Stacks};
pub use islands::{FaultyIsland, IslandFault, Islands};
pub use judgment::{Certificate, PagesVerdict, certify};
pub(crate) use overlap::OrientedFaces;
pub use overlap::{Crossings, PlanarCertificate, boundary_crossings, certify_planar, crossings};
pub use padding::PaddingVerdict;
pub use rounding::BitsVerdict;
pub use stacks::{EdgeKey, outline};
pub(crate) use topology::{Start, UvTopology};

/// Most offending faces and pairs that a certificate names.
const NAMED: usize = 8;

/// Returns the UV chart of every face: 0, 1, … in the order of their first faces, determined as in [`certify`].
///
/// Charts without UV area are numbered too.
pub fn chart_ids(positions: &[[f64; 3]], triangles: &[[u32; 3]], uvs: &[CornerUvs]) -> Vec<u32> {
    UvTopology::new(positions, triangles, uvs).charts.of_face
}
