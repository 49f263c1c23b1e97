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
