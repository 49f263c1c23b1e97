//! Surfaces, their cuts and their maps to the plane: arrays in, maps and proofs out.
//!
//! | module | contents |
//! |---|---|
//! | [`mesh`] | surfaces welded by position, adjacency, defects; [`mesh::Disk`], proven to be one disk; planar and tetrahedral meshes |
//! | [`plane`] | geometry of the plane: a spatial index, segments, polygons, overlapping triangles |
//! | [`cut`] | surfaces opened along seams to disks |
//! | [`embed`] | a valid start for every disk, and its optimization |
//! | [`certificate`] | exact judgment of given UVs |
//! | [`measure`] | distortion, seams, packing and overlaps of given UVs |
//!
//! The judge, [`certificate`], shares only exact predicates and mesh types with the code that it judges: the other
//! modules find overlaps with [`plane`], and only [`measure`] imports the certificate.
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod certificate;
pub mod cut;
pub mod embed;
pub mod measure;
pub mod mesh;
pub mod plane;
