//! What is deformed besides surfaces with UVs: shapes from pictures and drawings, surfaces in cages, pictures on grids.
//!
//! Pure geometry, independent of the solver: each part makes a [`PlanarMesh`](crate::mesh::PlanarMesh) or
//! [`TetMesh`](crate::mesh::TetMesh) to deform and, afterwards, carries what lay in it along.

pub mod cage;
#[cfg(feature = "files")]
pub mod outline;
pub mod warp;
