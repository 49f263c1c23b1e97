//! The options of the applications: shared groups, and the options of each.
//!
//! Every option is declared [once](mod@unwrapd_api::options). Arrays are unwrapped with
//! [`Settings`](crate::Settings), which consists of the groups about geometry.
mod caller;
mod checks;
mod control;
mod deform;
mod edit;
mod measure;
mod repack;
mod unwrap;

pub use crate::settings::{
    Budget, Cutting, KeptMaps, Layout, Mapping, PackingMode, Stacking, Workers,
};
pub use caller::{Caller, CommandOptions};
pub(super) use checks::check_grouping;
pub use control::{Action, IslandControl, IslandRule, NamedRectangle, Selector, Straightening};
pub use deform::{BodyFormat, Course, DeformOptions, Pulling, SolveOptions};
pub(crate) use deform::{SolutionPlan, TRIANGLES};
pub use edit::{EditOptions, Editing, WarpOptions};
pub use measure::{MeasureOptions, VerifyOptions};
pub use repack::{Island, RepackOptions};
pub use unwrap::{Baking, GivenSeams, ImageFormat, NamedSeams, Options, Preset, Sets, TexelWeight};
pub(crate) use unwrap::{MOST_SIDE, Nodes};
