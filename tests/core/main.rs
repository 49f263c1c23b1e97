//! Tests of the geometry library.
