//! The options of the applications: shared groups, and the options of each.
//!
//! Every option is written [once](crate::options). Arrays are unwrapped with
//! [`Settings`](crate::pipeline::Settings), which consists of the groups that concern the geometry.

mod cutting;
mod layout;
mod mapping;
mod work;

#[cfg(feature = "files")]
mod baking;
#[cfg(feature = "files")]
mod caller;
#[cfg(feature = "files")]
mod course;
#[cfg(feature = "files")]
mod deform;
#[cfg(feature = "files")]
mod edit;
#[cfg(feature = "files")]
mod idle;
#[cfg(feature = "files")]
mod islands;
#[cfg(feature = "files")]
mod measure;
#[cfg(feature = "files")]
mod preset;
#[cfg(feature = "files")]
mod pulling;
#[cfg(feature = "files")]
mod repack;
#[cfg(feature = "files")]
mod sets;
#[cfg(feature = "files")]
mod solve;
#[cfg(feature = "files")]
mod unwrap;
#[cfg(feature = "files")]
mod unwrap_checks;
#[cfg(feature = "files")]
mod verify;
#[cfg(feature = "files")]
mod warp;

pub use cutting::{Cutting, KeptMaps};
pub use layout::{Layout, PackingMode};
pub use mapping::Mapping;
pub use work::{Budget, Workers};

#[cfg(feature = "files")]
pub use baking::Baking;
#[cfg(feature = "files")]
pub use caller::{Caller, CommandOptions};
#[cfg(feature = "files")]
pub use course::Course;
#[cfg(feature = "files")]
pub use deform::DeformOptions;
#[cfg(feature = "files")]
pub use edit::{EditOptions, Editing};
#[cfg(feature = "files")]
pub(super) use idle::check_grouping;
#[cfg(feature = "files")]
pub use islands::Island;
#[cfg(feature = "files")]
pub use measure::MeasureOptions;
#[cfg(feature = "files")]
pub use preset::Preset;
#[cfg(feature = "files")]
pub use pulling::Pulling;
#[cfg(feature = "files")]
pub use repack::RepackOptions;
#[cfg(feature = "files")]
pub use sets::Sets;
#[cfg(feature = "files")]
pub use solve::SolveOptions;
#[cfg(feature = "files")]
pub use unwrap::{GivenSeams, NamedSeams, Options};
#[cfg(feature = "files")]
pub use verify::VerifyOptions;
#[cfg(feature = "files")]
pub use warp::WarpOptions;
