//! Packing onto the integer grid.
