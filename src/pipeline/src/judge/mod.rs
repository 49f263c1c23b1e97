//! Quality and proven properties of a document's UVs, as stored in its written bytes.
pub(super) mod bound_report;
pub(super) mod group_uvs;
pub(super) mod groups;
pub(super) mod proven;
pub(super) mod report;
pub(super) mod rules;
pub(super) mod shortfalls;
pub(super) mod verify;
