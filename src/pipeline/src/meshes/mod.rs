//! Meshes given as arrays: unwrapped into one atlas, packed anew, measured and verified as those of files are.
//!
//! UVs have v up. Vertices at equal positions are one, of several meshes too, as in a document whose meshes share an atlas.

pub(super) mod arrays;
pub(super) mod judged;
pub(super) mod unwrap;
pub(super) mod welded;
