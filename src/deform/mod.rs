//! Bodies pulled by handles, no element inverted, and what lies in them carried along.
//!
//! A [`Body`] is a planar or tetrahedral mesh with rest shapes, a [`Problem`] a body with handles, their targets, a
//! [`DeformationEnergy`] and a barrier; [`Problem::solve`] moves the handles to their targets over maps that are all valid.
//! Bodies come from mesh files, from pictures and drawings (`outline`) and from surfaces put into a [`cage`], which carries
//! them along. Maps of the plane are pulled too: pictures by a grid over them (`warp_picture`), UVs by anchors ([`edit_uvs`]).

mod anchors;
mod body;
pub mod cage;
mod continuation;
mod edit_error;
mod handles;
mod idle;
mod model;
mod numbers;
#[cfg(feature = "files")]
pub mod outline;
mod parameterization;
#[cfg(feature = "files")]
mod picture_warp;
mod problem;
mod problem_error;
#[cfg(feature = "files")]
mod problem_file;
mod pull;
mod solve;
mod uv_chart;
pub mod warp;

pub use anchors::Anchor;
#[cfg(feature = "files")]
pub use anchors::parse_anchors;
pub use body::{Body, BodyElements};
pub use edit_error::EditError;
#[cfg(feature = "files")]
pub use handles::parse_body_handles;
pub use handles::{Handle, bind};
pub use model::DeformationEnergy;
#[cfg(feature = "files")]
pub use numbers::from_json;
pub use parameterization::{
    EditedChart, EditedUvs, UvBoundary, UvEditOptions, UvMesh, UvRest, edit_uvs,
};
#[cfg(feature = "files")]
pub use picture_warp::{
    Border, PictureHandle, PictureWarp, WarpError, WarpOptions, parse_handles, warp_picture,
};
pub use problem::{Model, Problem};
pub use problem_error::ProblemError;
#[cfg(feature = "files")]
pub use problem_file::{ProblemFile, Rest};
pub use pull::PullReport;
pub use solve::{Method, Solution, Worth};
pub use uv_chart::ChartFaces;
