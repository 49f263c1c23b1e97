//! Meshes given as arrays: unwrapped into one atlas, repacked, measured and verified like those of files.
//!
//! UVs have v up. Vertices at equal positions are identified, also across meshes, as in a document whose meshes share
//! an atlas.

pub(super) mod arrays;
pub(super) mod judged;
pub(super) mod unwrap;
pub(super) mod welded;
