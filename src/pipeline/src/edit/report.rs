//! Reports of edited UVs.

use serde::Serialize;

use crate::deform::missed::Completion;
use crate::deform::pull_report::PullReport;
use crate::judge::proven::Proven;
use unwrapd_deform::Unreached;
use unwrapd_deform::uv::{EditedUvs, UvRest};
use unwrapd_files::document::Warning;

/// Report on the edited UVs of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct EditReport {
    /// `true` if the whole UV set is proven in the bytes written: no face is flipped or degenerate, and no two faces
    /// that share a UV space overlap, whether their charts have anchors or not. Warnings name what is missing.
    pub certified: bool,
    /// `true` if the whole UV set is bijective in the bytes written.
    pub bijective: bool,
    /// Properties that are missing, in words.
    pub lacking: Vec<&'static str>,
    /// Proven properties of the whole UV set.
    pub proven: Proven,
    /// Degree to which the request was completed.
    pub completion: Completion,
    /// Warnings about the input file, the work and the written file.
    pub warnings: Vec<Warning>,
    /// The shapes that were kept.
    pub rest: UvRest,
    /// The charts with anchors.
    pub charts: Vec<ChartEditReport>,
}

/// Report on an edited chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ChartEditReport {
    /// Its number among the charts of the document, in the order of their first faces.
    pub chart: u32,
    /// Number of its faces that were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// Quality of the map; the certificate is about the bytes written.
    #[serde(flatten)]
    pub map: PullReport,
}

/// Returns the worst completion of all charts, with its warning.
pub(super) fn completion(edited: &EditedUvs) -> (Completion, Option<Warning>) {
    let summaries = || edited.charts.iter().map(|chart| &chart.summary);
    let worst = summaries().max_by_key(|summary| Completion::of(summary.status));
    let Some(status) = worst.map(|summary| summary.status) else {
        return (Completion::Complete, None);
    };
    let completion = Completion::of(status);
    let of_worst = summaries().filter(|summary| Completion::of(summary.status) == completion);
    let mut unreached: Vec<Unreached> = of_worst.flat_map(|s| s.unreached.clone()).collect();
    unreached.sort_by_key(|anchor| anchor.handle);
    (completion, completion.warning(status, &unreached))
}
