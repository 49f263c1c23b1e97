//! Maps that overlap themselves: where they do, which seam ends it, and how slight folds are pushed apart
//! without one.

mod contact;
pub(super) mod local_minimum;
pub(super) mod overlaps;
pub(super) mod push_apart;
mod surroundings;
