//! Tests of the geometry library.
mod atlas;
mod barrier;
mod energy;
mod numerics;
mod solver;
mod taylor;
mod disk;
