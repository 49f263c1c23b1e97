//! Surfaces: welding, adjacency, boundary loops, defects; planar and tetrahedral meshes.
//!
//! A [`Surface`] is any list of triangles made fit to be unwrapped: vertices at bit-equal positions are one vertex, faces
//! that repeat a position are left out, and what is broken is counted ([`Defects`]), never refused. Its [`Adjacency`] says
//! which faces are glued along which edge. Every edge is glued to at most one other, so where three or more faces meet,
//! the surface is cut open, and a vertex shared by two fans (a bow tie) falls apart by itself: what the adjacency
//! describes is always a 2-manifold, possibly with boundary, in several pieces, and possibly not orientable.
//!
//! A rest shape to be deformed is stricter: a [`PlanarMesh`] or [`TetMesh`] has elements of exactly positive size on different
//! sides of what they share, or it is refused with the element that is at fault.

mod adjacency;
mod canonical;
mod corner_uvs;
mod defects;
mod disk;
mod edges;
mod element_error;
mod planar;
mod resolution;
mod smoothed;
mod spread;
mod surface;
mod tets;
mod union_find;
mod used_vertices;
mod vertex_faces;
mod weld;

pub use adjacency::Adjacency;
pub use canonical::canonical_order;
pub use corner_uvs::{CornerUvs, VAxis};
pub use defects::{Defects, has_zero_area};
pub use disk::{Disk, NotADisk};
pub use edges::{CUT, Edges, next, origin, same_direction};
pub use element_error::ElementError;
pub use element_error::validate;
pub use planar::{PlanarMesh, boundary_edges};
pub use resolution::Resolution;
pub use spread::spread;
pub use surface::{MeshError, Surface};
pub use tets::{TetMesh, boundary_triangles};
pub use union_find::UnionFind;
pub use used_vertices::UsedVertices;
pub use vertex_faces::VertexFaces;
pub use weld::weld;
