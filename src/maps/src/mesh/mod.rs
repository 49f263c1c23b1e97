//! Surfaces: welding, adjacency, boundary loops, defects; planar and tetrahedral meshes.
//!
//! A [`Surface`] is any list of triangles prepared for unwrapping: vertices at bit-equal positions are one vertex,
//! faces that repeat a position are left out, and defects are counted ([`Defects`]), never refused. Its [`Adjacency`]
//! tells which faces are glued along which edge. Every halfedge is glued to at most one other, so where three or more
//! faces meet, the surface is cut open, and a vertex shared by two fans (a bow tie) falls apart by itself: the
//! adjacency always describes a 2-manifold, possibly with boundary, in several pieces, and possibly not orientable.
//!
//! A rest shape to be deformed is stricter: a [`PlanarMesh`] or [`TetMesh`] has elements of exactly positive size on
//! different sides of their common edges or faces; anything else is refused with the offending element.
mod adjacency;
mod disk;
mod edges;
mod elements;
mod needles;
mod surface;
mod uvs;

pub use adjacency::Adjacency;
pub use disk::{Disk, NotADisk};
pub use edges::{
    CUT, Edges, UnionFind, UsedVertices, VertexFaces, next, origin, same_direction, spread,
};
pub use elements::{
    ElementError, PlanarMesh, TetMesh, boundary_edges, boundary_triangles, validate,
};
pub use needles::{NEEDLE, NeedleStep, longest_side, looks_like_edge};
pub use surface::{Defects, MeshError, Surface, canonical_order, has_zero_area, weld};
pub use uvs::{CornerUvs, Resolution, VAxis};
