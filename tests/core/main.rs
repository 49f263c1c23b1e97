//! Tests of the geometry library.
mod atlas;
