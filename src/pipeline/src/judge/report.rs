//! The report: input, work done, and quality of the written bytes.

use super::bound_report::BoundReport;
use super::group_uvs::GroupUvs;
use super::proven::{Mirrored, Proven};
use super::rules::RuleReport;
use crate::arrays::unwrap::{ChartRecord, Unwrapped};
use crate::options::Options;
use serde::Serialize;
use unwrapd_api::Limits;
use unwrapd_files::document::{Warning, WriteNotes};
use unwrapd_maps::certificate::{Certificate, Overlap, chart_ids};
use unwrapd_maps::measure::Measures;
use unwrapd_maps::mesh::{Defects, Resolution};
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::solver::Status;

/// Version of the report schema. It increases when a key is removed or changes its meaning.
pub const SCHEMA_VERSION: u32 = 2;

/// The report of a document: what was read, what was done, and the quality of the written bytes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Report {
    /// Version of this schema.
    pub schema_version: u32,
    /// Version of the program.
    pub unwrapd_version: &'static str,
    /// The requested options; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub options: Option<Options>,
    /// The limits that applied; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<Limits>,
    /// `true` if everything requested is proven on the written bytes: no face is flipped or degenerate, no chart is
    /// mirrored and no two faces overlap except in accepted stacks, and padding, pages, alignment and bits are as
    /// requested. The warnings name what is missing. A missed distortion bound is only a warning. Islands that keep
    /// their shapes may be mirrored, as they are in the input.
    pub certified: bool,
    /// `true` if the work ended before it was done, at its time limit or on request. The result is no less certified.
    pub ended_early: bool,
    /// `true` if only a part of the request was done: textures or colors that `rebake` should resample were not. The
    /// warnings name them.
    pub partly_done: bool,
    /// Permission of mirrored charts.
    #[serde(skip)]
    pub(crate) mirrored: Mirrored,
    /// Proven properties of the written bytes, next to the requested ones.
    pub proven: Proven,
    /// Warnings about the input file, the work and the written file.
    pub warnings: Vec<Warning>,
    /// One entry per atlas, in document order.
    pub groups: Vec<GroupReport>,
    /// Changes to the document; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<WriteNotes>,
    /// Time of each stage; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Seconds>,
}

/// One atlas.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct GroupReport {
    /// `mesh0`, `mesh0/prim0`, `material0` or `scene`.
    pub name: String,
    /// Name for display: the name of the mesh or material, otherwise `mesh 0`, `material 0` or `Whole scene`.
    pub label: String,
    /// Mean number of texels per unit of length of the mesh, for materials of weight 1: the square root of
    /// UV area in texels over weighted surface area. Null if the surface has no area.
    pub texels_per_unit: Option<f64>,
    /// Distortion, seams, packing and overlaps, measured on the written bytes.
    pub measures: Measures,
    /// Exact judgment of the written bytes.
    pub certificate: Certificate,
    /// Rules for islands; absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rules: Vec<RuleReport>,
    /// Charts that share their texels; absent if there are no accepted stacks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stacks: Option<StacksReport>,
    /// Defects of the mesh; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defects: Option<Defects>,
    /// Details of the atlas; absent if existing UVs were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub atlas: Option<AtlasReport>,
}

/// Details of an atlas that was made.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct AtlasReport {
    /// UV length of one unit of length of the mesh, along the longer side of the texture.
    pub scale: f64,
    /// `name` of the group with the same atlas: its mesh has the same shape, so both were mapped and packed once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_as: Option<String>,
    /// Padding kept between charts, in texels at the requested resolution.
    pub padding_texels: f64,
    /// The bound on the distortion, and whether it was kept; absent unless `cut` is `auto`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<BoundReport>,
    /// The chart that alone sets the scale because it is as long as a page; absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<LimitReport>,
    /// One entry per chart that was mapped; charts of copies have none.
    pub charts: Vec<ChartReport>,
}

/// Charts that share their texels.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct StacksReport {
    /// Number of stacks.
    pub stacks: usize,
    /// Charts in them.
    pub charts: usize,
    /// Texels that these charts would take beside those that they share, at their size on the texture, if each had its
    /// own place.
    pub texels_gained: f64,
}

/// Chart that alone sets the scale of an atlas. Only a cut through it, or a texture of another shape, makes the atlas fuller.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct LimitReport {
    /// Index of the chart in `charts`.
    pub chart: usize,
    /// Upper bound of the share of the texture that any layout of these charts fills.
    pub utilization: f64,
}

/// Details of mapping a chart.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ChartReport {
    /// Triangles of the chart.
    pub faces: usize,
    /// Status at the end of the optimization.
    pub status: Status,
    /// Newton iterations.
    pub iterations: usize,
    /// Factorizations, failed ones included.
    pub factorizations: usize,
    /// Energy of the start, barrier included, rest shapes scaled to mean area 1.
    pub energy_first: f64,
    /// Energy at the end, in the same units.
    pub energy_last: f64,
    /// Seconds for the map of the chart that this one was cut from, its cutting included.
    pub seconds: f64,
}

/// Wall-clock time of each stage, in seconds.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Seconds {
    /// Reading the document.
    pub read: f64,
    /// Cutting, mapping and packing.
    pub unwrap: f64,
    /// Resampling textures.
    pub bake: f64,
    /// Writing the document.
    pub write: f64,
    /// Rereading and judging the written bytes.
    pub judge: f64,
}

impl Report {
    /// Creates the report of existing UVs, without facts that only unwrapping knows.
    pub(crate) fn new(
        groups: Vec<GroupReport>,
        warnings: Vec<Warning>,
        mirrored: Mirrored,
    ) -> Self {
        let proven = Proven::of(groups.iter().map(|group| &group.certificate));
        Self {
            schema_version: SCHEMA_VERSION,
            unwrapd_version: env!("CARGO_PKG_VERSION"),
            options: None,
            limits: None,
            certified: proven.lacks(Overlap::Test, mirrored).is_empty(),
            mirrored,
            ended_early: false,
            partly_done: false,
            proven,
            warnings,
            groups,
            written: None,
            seconds: None,
        }
    }
}

impl Report {
    /// Returns the requested properties that do not hold, in words.
    pub fn lacking(&self) -> Vec<&'static str> {
        self.proven.lacks(Overlap::Test, self.mirrored)
    }
}

impl GroupReport {
    /// Creates the report of a group's UVs.
    pub(crate) fn new(
        uvs: &GroupUvs,
        measures: Measures,
        certificate: Certificate,
        texture: Resolution,
    ) -> Self {
        let area = uvs.intended_area().unwrap_or(measures.size.area_3d);
        let squared = measures.size.area_uv / area;
        Self {
            name: uvs.name.clone(),
            label: uvs.label.clone(),
            texels_per_unit: (area > 0.0).then(|| f64::from(texture.height) * squared.sqrt()),
            measures,
            stacks: StacksReport::of(uvs, &certificate, texture),
            certificate,
            rules: Vec::new(),
            defects: None,
            atlas: None,
        }
    }

    /// Returns whether everything requested is proven for this atlas, and no chart is mirrored outside of stacks.
    pub fn is_certified(&self) -> bool {
        let proven = Proven::of(std::iter::once(&self.certificate));
        proven.lacks(Overlap::Test, Mirrored::InStacks).is_empty()
    }
}

impl StacksReport {
    /// Measures accepted stacks; returns `None` if there are none.
    fn of(uvs: &GroupUvs, certificate: &Certificate, texture: Resolution) -> Option<Self> {
        let stacks = certificate
            .stacks
            .as_deref()
            .filter(|stacks| !stacks.is_empty())?;
        let mut areas: Vec<f64> = Vec::new();
        let charts = chart_ids(&uvs.positions, &uvs.triangles, &uvs.uvs);
        for (chart, [a, b, c]) in charts.into_iter().zip(&uvs.uvs) {
            areas.resize(areas.len().max(chart as usize + 1), 0.0);
            areas[chart as usize] += doubled_area(*a, *b, *c).abs() / 2.0;
        }
        let saved = stacks
            .iter()
            .map(|charts| areas[charts[0] as usize] * (charts.len() - 1) as f64);
        let texels = f64::from(texture.width) * f64::from(texture.height);
        Some(Self {
            stacks: stacks.len(),
            charts: stacks.iter().map(Vec::len).sum(),
            texels_gained: (texels * saved.sum::<f64>()).round(),
        })
    }
}

impl AtlasReport {
    pub(crate) fn new(unwrapped: &Unwrapped) -> Self {
        Self {
            scale: unwrapped.scale,
            padding_texels: unwrapped.padding_texels,
            bound: None,
            same_as: None,
            limit: unwrapped.limit.map(|limit| LimitReport {
                chart: limit.chart,
                utilization: limit.utilization,
            }),
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
