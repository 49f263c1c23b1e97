//! From a mesh to a certified atlas and its report.
//!
//! [`unwrap`] takes plain arrays: it welds, cuts, maps every chart and packs. [`unwrap_document`] takes a file's bytes:
//! it reads, unwraps every group of primitives, writes, and then reads the written bytes again; the report and the
//! certificate are about those bytes and nothing else. [`measure_document`] and [`verify_document`] do the same for
//! UVs that a file already has; [`edit_document`] changes them, [`repack_document`] packs them anew.
//!
//! The other applications are a function from a file's bytes to files' bytes each: [`solve_file`], [`deform_file`], [`warp_file`].
//! All take options of their own, [`Limits`] that their caller sets, and an [`Observer`]; the command line and the service are
//! two ways to call them.
//!
//! The work runs on a thread pool of its own. Charts of all groups share one queue, largest first; each is mapped by
//! one thread, so the result does not depend on their number. Meshes of one shape are mapped once, and packed once where each has an
//! atlas of its own; the written bytes are certified for each.
//!
//! **Certified** means that everything that was asked for is proven on the written bytes ([`Report::certified`] has the list). What is
//! not proven stands among the warnings; only flips where none were promised are an error, and leave no file.

mod alike;
mod arrays;
mod clearance;
mod compact;
mod divided;
mod error;
mod map;
mod observer;
mod options;
mod portion;
mod repeated;
mod seams;
mod settings;
mod soup;

#[cfg(feature = "files")]
mod bodies;
#[cfg(feature = "files")]
mod bound_report;
#[cfg(feature = "files")]
mod cage_map;
#[cfg(feature = "files")]
mod caged;
#[cfg(feature = "files")]
mod deform;
#[cfg(feature = "files")]
mod documents;
#[cfg(feature = "files")]
mod edit;
#[cfg(feature = "files")]
mod edit_terms;
#[cfg(feature = "files")]
mod group_uvs;
#[cfg(feature = "files")]
mod judge;
#[cfg(feature = "files")]
mod limits;
#[cfg(feature = "files")]
mod merged;
#[cfg(feature = "files")]
mod moved;
#[cfg(feature = "files")]
mod nodes;
mod packed;
mod packing;
#[cfg(feature = "files")]
mod pictures;
#[cfg(feature = "files")]
mod planar_map;
#[cfg(feature = "files")]
mod prepared;
#[cfg(feature = "files")]
mod proven;
#[cfg(feature = "files")]
mod pull_report;
#[cfg(feature = "files")]
mod question;
#[cfg(feature = "files")]
mod rebake;
#[cfg(feature = "files")]
mod repack;
#[cfg(feature = "files")]
mod report;
#[cfg(feature = "files")]
mod shortfalls;
#[cfg(feature = "files")]
mod solution;
#[cfg(feature = "files")]
mod solve;
#[cfg(feature = "files")]
mod source;
#[cfg(feature = "files")]
mod texel_weight;
#[cfg(feature = "files")]
mod verify;
#[cfg(feature = "files")]
mod warp;

pub use arrays::{ChartRecord, GridCorners, Unwrapped, unwrap, unwrap_along};
pub use error::PipelineError;
pub use observer::{Observer, Progress, Stage, Unobserved};
pub use options::{Budget, Cutting, KeptMaps, Layout, Mapping, PackingMode, Workers};
pub use seams::Seams;
pub use settings::Settings;

#[cfg(feature = "files")]
pub use bodies::BodyFormat;
#[cfg(feature = "files")]
pub use bound_report::{BoundReport, WorstChart, stretch_percent};
#[cfg(feature = "files")]
pub use caged::{CageOptions, CageReport, CagedDocument, Surfaces};
#[cfg(feature = "files")]
pub use deform::deform_file;
#[cfg(feature = "files")]
pub use documents::{Outcome, unwrap_document};
#[cfg(feature = "files")]
pub use edit::{ChartEditReport, EditReport, EditedDocument, edit_document};
#[cfg(feature = "files")]
pub use limits::Limits;
#[cfg(feature = "files")]
pub use options::{
    Baking, Caller, CommandOptions, Course, DeformOptions, EditOptions, Editing, GivenSeams,
    MeasureOptions, NamedSeams, Options, Preset, RepackOptions, Sets, SolveOptions, WarpOptions,
};
#[cfg(feature = "files")]
pub use pictures::{Drawn, Pictures};
#[cfg(feature = "files")]
pub use proven::{Mirrored, Proven, ProvenBits, ProvenPadding, ProvenPages};
#[cfg(feature = "files")]
pub use pull_report::PullReport;
#[cfg(feature = "files")]
pub use rebake::ImageFormat;
#[cfg(feature = "files")]
pub use repack::repack_document;
#[cfg(feature = "files")]
pub use report::{AtlasReport, ChartReport, GroupReport, Report, SCHEMA_VERSION, Seconds};
#[cfg(feature = "files")]
pub use solution::{DeformReport, Deformed};
#[cfg(feature = "files")]
pub use solve::solve_file;
#[cfg(feature = "files")]
pub use texel_weight::TexelWeight;
#[cfg(feature = "files")]
pub use verify::{Verified, VerifiedGroup, measure_document, verify_document};
#[cfg(feature = "files")]
pub use warp::{WarpReport, WarpedPicture, warp_file};
