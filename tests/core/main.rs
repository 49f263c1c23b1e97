//! Tests of the geometry library.
mod atlas;
mod barrier;
mod box_tree;
mod certificate;
mod charts;
mod cut;
mod disk;
#[cfg(feature = "files")]
mod document;
mod embed;
mod energy;
#[cfg(feature = "files")]
mod io;
mod layers;
mod measure;
mod mesh;
mod numerics;
#[cfg(feature = "files")]
mod obj_document;
#[cfg(feature = "files")]
mod picture;
mod pipeline;
mod solver;
mod taylor;
mod uv_meshes;
mod zoo;
