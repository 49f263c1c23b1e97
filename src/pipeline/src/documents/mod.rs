//! Unwrapping and packing of documents: read, prepared, merged by group, written, read again and judged.

pub(super) mod merged;
pub(super) mod nodes;
pub(super) mod pictures;
pub(super) mod prepared;
pub(super) mod repack;
pub(super) mod texel_weight;
pub(super) mod unwrap;
pub(super) mod uv_arrays;
