//! What the UVs of a document are worth, and what is proven of them, as its written bytes have them.

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
