//! The options of the applications: shared groups, and the options of each.
//!
//! Every option is declared [once](mod@unwrapd_api::options). Arrays are unwrapped with
//! [`Settings`](crate::Settings), which consists of the groups about geometry.

mod cutting;
mod layout;
mod mapping;
mod work;

mod baking;
mod caller;
mod course;
mod deform;
mod edit;
mod idle;
mod islands;
mod measure;
mod preset;
mod pulling;
mod repack;
mod sets;
mod solve;
mod unwrap;
mod unwrap_checks;
mod verify;
mod warp;

pub use cutting::{Cutting, KeptMaps};
pub use layout::{Layout, PackingMode};
pub use mapping::Mapping;
pub use work::{Budget, Workers};

pub use baking::Baking;
pub use caller::{Caller, CommandOptions};
pub use course::Course;
pub use deform::DeformOptions;
pub use edit::{EditOptions, Editing};
pub(super) use idle::check_grouping;
pub use islands::Island;
pub use measure::MeasureOptions;
pub use preset::Preset;
pub use pulling::Pulling;
pub use repack::RepackOptions;
pub use sets::Sets;
pub use solve::SolveOptions;
pub use unwrap::{GivenSeams, NamedSeams, Options};
pub use verify::VerifyOptions;
pub use warp::WarpOptions;
