//! Tests of the geometry library.
mod atlas;
mod barrier;
mod disk;
mod embed;
mod energy;
#[cfg(feature = "files")]
mod io;
mod numerics;
mod solver;
mod taylor;
