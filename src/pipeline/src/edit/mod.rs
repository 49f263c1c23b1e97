//! UVs of a document edited by anchors.

pub(super) mod held;
pub(super) mod report;
pub(super) mod terms;
pub(super) mod uvs;
