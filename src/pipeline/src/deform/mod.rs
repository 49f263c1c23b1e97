//! Deformation by handles of meshes, solids, pictures and surfaces in a cage, and problem files.
pub(super) mod caged;
pub(super) mod live;
pub(super) mod solution;
pub(super) mod solve;
pub(super) mod source;
pub(super) mod untangle;
pub(super) mod warp;
