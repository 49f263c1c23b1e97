//! Placement of each chart on one page.

use super::alignment::chart_bounds;
use super::topology::UvTopology;
use serde::Serialize;

/// Verdict on the placement of every chart on one of the pages, decided exactly. Page k covers u from k to k + 1 and
/// v from 0 to 1, borders included.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PagesVerdict {
    /// The requested number of pages.
    pub asked: u32,
    /// `true` if every chart lies on one of them.
    pub kept: bool,
    /// Pages that hold a chart.
    pub used: usize,
    /// Charts that cross a page border or lie outside all pages.
    pub charts_across: usize,
}

pub(super) fn judge_pages(topology: &UvTopology, asked: u32) -> PagesVerdict {
    let mut is_used = vec![false; asked as usize];
    let mut charts_across = 0;
    for [low, high] in chart_bounds(topology) {
        // The left border of the page in question; a chart without width on a border lies on the page to its right.
        let page = low[0].floor();
        let is_across = high[0] > page + 1.0 || low[1] < 0.0 || high[1] > 1.0;
        match is_used.get_mut(page as usize) {
            Some(used) if page >= 0.0 && !is_across => *used = true,
            _ => charts_across += 1,
        }
    }
    PagesVerdict {
        asked,
        kept: charts_across == 0,
        used: is_used.iter().filter(|used| **used).count(),
        charts_across,
    }
}
