//! From a mesh to a certified atlas and its report.
//!
//! [`unwrap`] takes plain arrays: it welds, cuts, maps every chart and packs. [`unwrap_document`] takes a file's
//! bytes: it reads, unwraps every group of primitives, writes, and then reads the written bytes again. The report and
//! the certificate are about those bytes and nothing else. [`measure_document`] and [`verify_document`] do the same
//! for existing UVs of a file; [`edit_document`] changes them, and [`repack_document`] packs them again.
//! [`unwrap_meshes`], [`repack_meshes`], [`measure_meshes`] and [`verify_meshes`] do this for several meshes given as
//! arrays.
//!
//! The other applications are functions from bytes of a file to bytes of files: [`solve_file`], [`deform_file`],
//! [`warp_file`]. All take options of their own, [`Limits`] set by their caller, and an [`Observer`]; the command
//! line and the service are two such callers. [`open_body`], [`open_picture`], [`open_uvs`] and [`open_islands`] open
//! live sessions on what these functions and [`repack_document`] would change.
//!
//! The work runs on its own thread pool. Charts of all groups share one queue, largest first; each is mapped by one
//! thread, so the result does not depend on the number of threads. Meshes of equal shape are mapped once, and packed
//! once if each has its own atlas; the written bytes are certified for each.
//!
//! **Certified** means that everything requested is proven on the written bytes ([`Report::certified`] has the list).
//! The warnings list what is not proven; only flips where none are allowed are an error, and leave no file.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod arrange;
mod arrays;
mod deform;
mod documents;
mod edit;
mod error;
mod island_error;
mod judge;
mod limits;
mod meshes;
mod observer;
mod options;
mod portion;
mod rebake;
mod settings;
mod start;
mod tracker;

pub use arrange::{IslandHandle, IslandSession, LiveIslands, Place, open_islands};
pub use arrays::control::{DensityRule, FaceControl, FaceRules};
pub use arrays::placement::Placement;
pub use arrays::repeated::GridCorners;
pub use arrays::seams::Seams;
pub use arrays::settings::Settings;
pub use arrays::unwrap::{ChartRecord, Unwrapped, in_pool, unwrap, unwrap_along};
pub use deform::caged::{CageOptions, CagedDocument, Surfaces};
pub use deform::live::{SessionBody, Skin, open_body, open_picture};
pub use deform::solution::{CageReport, Completion, DeformReport, Deformed, PullReport};
pub use deform::solve::{deform_file, solve_file, solve_problem};
pub use deform::untangle::{
    UntangleOptions, UntangleReport, Untangled, UntangledMesh, untangle_file, untangle_mesh,
};
pub use deform::warp::{WarpReport, WarpedPicture, warp_file};
pub use documents::pictures::{AtlasPicture, Pictures, ReportOfAtlas};
pub use documents::unwrap::{Outcome, repack_document, unwrap_document};
pub use documents::uv_arrays::UvArrays;
pub use edit::{ChartEditReport, EditReport, EditedDocument, SessionUvs, edit_document, open_uvs};
pub use error::PipelineError;
pub use island_error::IslandError;
pub use judge::bound_report::{BoundReport, WorstChart, stretch_percent};
pub use judge::proven::{Mirrored, Proven, ProvenBits, ProvenPadding, ProvenPages, ProvenStacks};
pub use judge::report::{
    AtlasReport, ChartReport, GroupReport, LimitReport, Report, SCHEMA_VERSION, Seconds,
    StacksReport,
};
pub use judge::rules::{ChangedIsland, RuleReport};
pub use judge::verify::{Judged, Verified, VerifiedGroup, measure_document, verify_document};
pub use meshes::{
    MeshArrays, UnwrappedMeshes, WeldedUvs, measure_meshes, repack_meshes, unwrap_meshes,
    verify_meshes,
};
pub use observer::{Observer, Progress, Unobserved};
pub use options::{
    Action, Baking, BodyFormat, Budget, Caller, CommandOptions, Course, Cutting, DeformOptions,
    EditOptions, Editing, GivenSeams, ImageFormat, Island, IslandControl, IslandRule, KeptMaps,
    Layout, Mapping, MeasureOptions, NamedRectangle, NamedSeams, Options, PackingMode, Preset,
    Pulling, RepackOptions, Selector, Sets, SolveOptions, Stacking, Straightening, TexelWeight,
    VerifyOptions, WarpOptions, Workers,
};
pub use start::{start_file, start_file_of_text};
pub use unwrapd_api::{Limits, START, Stage};
