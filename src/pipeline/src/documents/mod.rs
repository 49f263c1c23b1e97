//! Unwrapping and packing of documents: read, prepared, merged by group, written, read again and judged.
pub(super) mod corner_selection;
pub(super) mod input;
pub(super) mod pictures;
pub(super) mod selection;
pub(super) mod unwrap;
pub(super) mod uv_arrays;
