//! Surfaces that are their own mirror images, cut alike on both sides.
//!
//! [`mirror_plane`](search::mirror_plane) finds the plane. A closed surface is opened along it ([`opening`]), and every seam on
//! one side is drawn once more on the other: where triangles are mirrored along the same edges, elsewhere along the
//! cheapest way near the mirror image ([`way`]). Charts that lie on both sides stay whole.

pub mod chains;
pub mod counterpart;
pub mod edge_images;
pub mod image;
pub mod opening;
pub mod own_image;
pub mod plane;
pub mod search;
pub mod sheet_mirror;
pub mod way;

mod cloud;

use serde::{Deserialize, Serialize};

/// Treatment of surfaces that are their own mirror images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Symmetry {
    /// Find a mirror plane, exact or near, and cut alike on both sides of it.
    #[default]
    Auto,
    /// Cut without regard to mirror planes.
    Off,
}
