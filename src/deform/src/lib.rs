//! Bodies deformed by handles without inverting elements, and objects embedded in them that follow.
//!
//! A [`Body`] is a planar or tetrahedral mesh with rest shapes; a [`Problem`] is a body with handles, their targets, a
//! [energy](unwrapd_method::energy::EnergyKind) and a barrier. [`Problem::solve`] moves the handles to their targets
//! over maps that are all valid; a [`Session`] does so an iteration at a time while handles are added, moved and
//! removed. The objective is available as a function of positions, with gradient and Hessian ([`Problem::potential`]).
//! Bodies come from mesh files, from pictures and drawings (`outline`) and from surfaces in a [`cage`], which carries
//! them along. Maps of the plane are pulled too: pictures by a grid over them ([`warp`]), UVs by anchors ([`uv`]).
#![doc = include_str!("guide.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod body;
pub mod boundary_barrier;
pub mod cage;
mod editor;
mod feasibility;
mod folded;
mod handle;
mod handle_path;
mod handles;
mod harmonic_start;
mod line;
mod missing;
mod normalized;
pub mod outline;
mod path_search;
mod potential;
mod problem;
mod problem_error;
mod problem_file;
mod pull;
mod region;
mod session;
mod soft;
mod solve;
mod terms;
mod turns_left;
mod untangle;
pub mod uv;
pub mod warp;
mod winding;

pub use body::{Body, BodyElements, Boundary};
pub use editor::{Editable, Editor, HandleId};
pub use folded::{FoldedMesh, RestOfFolded, Unfolded};
pub use handle::{Handle, Select, parse_body_handles};
pub use handles::{Aim, Bound, Turned, bind};
pub use normalized::MapQuality;
pub use potential::Potential;
pub use problem::{Model, Problem, Units};
pub use problem_error::ProblemError;
pub use problem_file::{ProblemFile, ProblemHandles, Rest};
pub use pull::{PullSummary, Unreached};
pub use region::{Line, Region};
pub use session::{LiveBody, Session};
pub use soft::SoftPull;
pub use solve::{Method, Solution};
pub use turns_left::Turns;
