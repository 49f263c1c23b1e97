//! Quality and proven properties of a document's UVs, as stored in its written bytes.

pub(super) mod bound_report;
pub(super) mod group_uvs;
pub(super) mod groups;
pub(super) mod history;
mod mean_energy;
pub(super) mod proven;
pub(super) mod question;
pub(super) mod report;
pub(super) mod shortfalls;
mod smoothed_distortion;
pub(super) mod verify;
