//! Editing of a document's UVs by anchors.

pub(super) mod report;
pub(super) mod uvs;
