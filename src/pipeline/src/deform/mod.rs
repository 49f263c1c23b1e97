//! Deformation by handles of meshes, solids, pictures and surfaces in a cage, and problem files.

pub(super) mod cage_report;
pub(super) mod caged;
pub(super) mod file;
pub(super) mod formats;
mod frames;
pub(super) mod live;
pub(super) mod missed;
pub(super) mod moved;
pub(super) mod plan;
pub(super) mod pull_report;
pub(super) mod solution;
pub(super) mod solve;
pub(super) mod source;
pub(super) mod warp;
