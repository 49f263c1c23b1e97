//! Seams: surfaces opened to disks.
//!
//! A seam is an edge along which two faces are no longer glued. [`Sheet`] is a part of a surface with its gluing;
//! [`open_to_disk`] cuts as few edges as possible to make the sheet a disk, possibly with holes:
//!
//! - a sheet of genus 0 with a boundary stays as it is;
//! - a closed sheet of genus 0 gets a slit between two vertices far apart, with branches to vertices far from it;
//! - any other gets a cut graph: the tree–cotree decomposition (Eppstein 2003) rooted in the shortest loop that does
//!   not separate, greedily as Erickson and Whittlesey (2005) choose their loops, leaving its holes alone.
//!
//! The decomposition never needs an orientation, so a Möbius strip is opened by the same code as a torus. Cut parts can
//! be joined again at single edges ([`join_disks`]): two disks glued along one edge are a disk, whatever they were cut
//! from. Last, [`isolate_doubled_edges`] cuts out faces where a non-manifold input would give a chart two edges between
//! one pair of vertices, which no straight-line map can draw.
//!
//! Nothing here makes a map, and nothing is moved or subdivided.
mod distances;
mod join;
mod open;
mod sheet;

pub use distances::{Neighbors, distances, distances_until, opposite_end};
pub use join::join_disks;
pub use open::{Branches, far_pairs, open_to_disk, ways_to_open};
pub use sheet::{Sheet, isolate_doubled_edges, surface_fans};
