//! Files: readers and writers of meshes, glTF and OBJ documents, pictures, and textures resampled from one UV map to another.
//!
//! | module | contents |
//! |---|---|
//! | [`io`] | readers and writers of mesh files, and the table of formats |
//! | [`polygon`] | triangles inside polygons |
//! | [`document`] | glTF, OBJ and others, with everything else in the file preserved |
//! | [`picture`] | UV layouts and distortion as PNG, pictures with transparency |
//! | [`bake`] | textures resampled from one UV map of a surface to another |
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod bake;
pub mod document;
pub mod io;
pub mod picture;
pub mod polygon;
