//! What is reported of edited UVs.

use serde::Serialize;

use crate::deform::Unreached;
use crate::deform::uv::{EditedUvs, UvRest};
use crate::document::Warning;
use crate::pipeline::deform::missed::{is_complete, missed, missed_warning};
use crate::pipeline::deform::pull_report::PullReport;

/// What was done to the UVs of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct EditReport {
    /// Whether every chart with an anchor is proven to be without flips in the bytes written.
    pub certified: bool,
    /// Whether, beyond that, none of them overlaps itself.
    pub bijective: bool,
    /// What users should know of the file that was read, of the work and of the file that was written.
    pub warnings: Vec<Warning>,
    /// The shapes that were kept.
    pub rest: UvRest,
    /// The charts with anchors.
    pub charts: Vec<ChartEditReport>,
}

impl EditReport {
    /// Is every anchor at its target, or was there no time to bring it there?
    pub fn is_complete(&self) -> bool {
        is_complete(&self.warnings)
    }
}

/// What was done to a chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct ChartEditReport {
    /// Its number among the charts of the document, in the order of their first faces.
    pub chart: u32,
    /// How many of its faces were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// What the map is worth; the certificate is about the bytes written.
    #[serde(flatten)]
    pub map: PullReport,
}

/// What to know of anchors that did not come to their targets.
pub(super) fn unreached(edited: &EditedUvs) -> Option<Warning> {
    let summaries = edited.charts.iter().map(|chart| &chart.summary);
    let all = summaries.flat_map(|summary| missed(summary.status, &summary.unreached));
    let mut all: Vec<Unreached> = all.copied().collect();
    all.sort_by_key(|anchor| anchor.handle);
    missed_warning(&all)
}
