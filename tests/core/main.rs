//! Tests of the geometry library.
mod atlas;
mod barrier;
mod charts;
mod cut;
mod disk;
mod embed;
mod energy;
#[cfg(feature = "files")]
mod io;
mod mesh;
mod numerics;
#[cfg(feature = "files")]
mod obj_document;
mod solver;
mod taylor;
mod zoo;
