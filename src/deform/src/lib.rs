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

mod aims;
mod attempt;
mod axes;
mod bends;
mod body;
mod bound;
mod boundary;
pub mod boundary_barrier;
pub mod cage;
mod cells;
mod continuation;
mod editor;
mod handle_path;
mod handles;
mod idle;
mod live;
mod locate;
mod missing;
mod normalized;
mod numbers;
pub mod outline;
mod paired;
mod path_search;
mod potential;
mod problem;
mod problem_error;
mod problem_file;
mod pull;
mod quality;
mod session;
mod shake;
mod solve;
mod terms;
mod turns_left;
mod units;
mod unreached;
mod untangle;
pub mod uv;
pub mod warp;

pub use aims::Aim;
pub use body::{Body, BodyElements};
pub use bound::Turned;
pub use boundary::Boundary;
pub use editor::{Editable, Editor, HandleId};
pub use handles::parse_body_handles;
pub use handles::{Bound, Handle, bind};
pub use potential::Potential;
pub use problem::{Model, Problem};
pub use problem_error::ProblemError;
pub use problem_file::ProblemHandles;
pub use problem_file::{ProblemFile, Rest};
pub use pull::PullSummary;
pub use quality::MapQuality;
pub use session::{LiveBody, Session};
pub use solve::{Method, Solution};
pub use turns_left::Turns;
pub use units::Units;
pub use unreached::Unreached;
