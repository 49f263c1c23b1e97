//! The report: what was read, what was done, and what the written bytes are worth.

use serde::Serialize;

use super::arrays::{ChartRecord, Unwrapped};
use super::bound_report::BoundReport;
use super::limits::Limits;
use super::options::Options;
use super::proven::{Mirrored, Proven};
use crate::certificate::{Certificate, Overlap};
use crate::document::{Warning, WriteNotes};
use crate::measure::Measures;
use crate::mesh::Defects;
use crate::solver::Status;

/// Version of the report's schema; it rises when a key changes its meaning or goes.
pub const SCHEMA_VERSION: u32 = 2;

/// The report of a document: what was read, what was done, and what the written bytes are worth.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Report {
    /// Version of this schema.
    pub schema_version: u32,
    /// Version of the program.
    pub unwrapd_version: &'static str,
    /// What was asked for; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub options: Option<Options>,
    /// What it was allowed to use of that; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<Limits>,
    /// Whether everything that was asked for is proven on the written bytes: no face flipped or without area, no chart mirrored, no two
    /// faces overlapping, and padding, pages, alignment and bits as asked. What is missing stands among the warnings. A bound on
    /// the distortion that is missed is a warning too, but does not count.
    pub certified: bool,
    /// What is proven on the written bytes, beside what was asked for.
    pub proven: Proven,
    /// What users should know of the file that was read, of the work and of the file that was written.
    pub warnings: Vec<Warning>,
    /// One entry per atlas, in the document's order.
    pub groups: Vec<GroupReport>,
    /// What was changed in the document; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<WriteNotes>,
    /// Where the time went; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Seconds>,
}

/// One atlas.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct GroupReport {
    /// `mesh0`, `mesh0/prim0`, `material0` or `scene`.
    pub name: String,
    /// What the file calls it, for people: the name of the mesh or the material, else `mesh 0` or `material 0`.
    pub label: String,
    /// Texels along one unit of length of the mesh, of materials of weight 1: the root of the area of all faces in texels over that on
    /// the surface, enlarged by its weights; null where the surface has none.
    pub texels_per_unit: Option<f64>,
    /// Distortion, seams, packing and overlaps, measured on the written bytes.
    pub measures: Measures,
    /// Exact judgment of the written bytes.
    pub certificate: Certificate,
    /// What was found to be wrong with the mesh; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defects: Option<Defects>,
    /// How the atlas was made; absent where existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub atlas: Option<AtlasReport>,
}

/// How an atlas was made.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct AtlasReport {
    /// UV length of one unit of length of the mesh, along the longer side of the texture.
    pub scale: f64,
    /// `name` of the group that has the same atlas, since its mesh has the same shape: it was mapped and packed once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_as: Option<String>,
    /// Padding kept between charts, in texels at the resolution asked for.
    pub padding_texels: f64,
    /// What was asked of the distortion, and whether it was kept; absent where `cut` is not `auto`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<BoundReport>,
    /// One entry per chart.
    pub charts: Vec<ChartReport>,
}

/// How a chart was mapped.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct ChartReport {
    /// Triangles of the chart.
    pub faces: usize,
    /// How the optimization ended.
    pub status: Status,
    /// Newton iterations.
    pub iterations: usize,
    /// Factorizations, failed ones included.
    pub factorizations: usize,
    /// Energy of the start, barrier included, rest shapes scaled to mean area 1.
    pub energy_first: f64,
    /// Energy at the end, in the same units.
    pub energy_last: f64,
    /// Seconds from the chart's start to its end.
    pub seconds: f64,
}

/// Where the time went, in seconds of the wall clock.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Seconds {
    /// Reading the document.
    pub read: f64,
    /// Cutting, mapping and packing.
    pub unwrap: f64,
    /// Resampling textures.
    pub bake: f64,
    /// Writing the document.
    pub write: f64,
    /// Reading the written bytes again and judging them.
    pub judge: f64,
}

impl Report {
    /// The report of UVs as they are: what only unwrapping knows is absent.
    pub(super) fn new(groups: Vec<GroupReport>, warnings: Vec<Warning>) -> Self {
        let proven = Proven::of(groups.iter().map(|group| &group.certificate));
        Self {
            schema_version: SCHEMA_VERSION,
            unwrapd_version: env!("CARGO_PKG_VERSION"),
            options: None,
            limits: None,
            certified: proven.lacks(Overlap::Test, Mirrored::Refused).is_empty(),
            proven,
            warnings,
            groups,
            written: None,
            seconds: None,
        }
    }
}

impl GroupReport {
    /// Whether everything that was asked for is proven of it, as [`Report::certified`] says of all.
    pub fn is_certified(&self) -> bool {
        let proven = Proven::of(std::iter::once(&self.certificate));
        proven.lacks(Overlap::Test, Mirrored::Refused).is_empty()
    }
}

impl AtlasReport {
    pub(super) fn new(unwrapped: &Unwrapped) -> Self {
        Self {
            scale: unwrapped.scale,
            padding_texels: unwrapped.padding_texels,
            bound: None,
            same_as: None,
            charts: unwrapped.charts.iter().map(ChartReport::new).collect(),
        }
    }
}

impl ChartReport {
    fn new(record: &ChartRecord) -> Self {
        Self {
            faces: record.faces,
            status: record.summary.status,
            iterations: record.summary.iterations,
            factorizations: record.summary.factorizations,
            energy_first: record.summary.energy_first,
            energy_last: record.summary.energy_last,
            seconds: record.seconds,
        }
    }
}
