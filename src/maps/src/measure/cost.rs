//! The cost of a layout: one objective for seams, charts and fill.
//!
//! ```text
//! cost = ln(1/2 + S + (n − k)/10) + c · (1 − f)
//! ```
//!
//! S is the length of the seams over the square root of the surface's area, n the number of charts, k the number of
//! components and f the fill: the share of the page that the charts cover. Distortion is not a term but a bound, and a
//! layout over its bound ranks below every layout within it.
//!
//! - **The logarithm** prices a seam relative to the seams that are there. A linear price has no weight at which cuts
//!   that clearly pay (a snake that fills .56 of a page, and .74 after two cuts) cost less than cuts that clearly do not
//!   (a hair card cut in two).
//! - **1/2** keeps a first short seam from being priced without limit; layouts of half that length are told apart by
//!   their fill.
//! - **1/10** of a side for each chart beyond one per component; weights from .05 to .4 choose the same layouts within .02.
//!   Counting from k keeps a file of 240 cards from making every further cut cheap.
//! - **c** is 1 for a given page ([`GIVEN_PAGE`]): what people's layouts imply, whose median fill is .70. It is 2 if the page may
//!   have another shape ([`ANY_PAGE`]), with f the mean of the fill of the square, for which the file is written, and of the
//!   best of the pages 1:1, 2:1, 4:1 and 8:1. The best page alone leaves a long chart whole that fills .18 of the square.
//!
//! The form and its weights come from a study of 2,300 layouts of 264 meshes, among them 30 with the UVs of artists.

use super::faces::Seams;
use super::packing::Packing;
use crate::certificate::UvTopology;
use crate::mesh::UnionFind;
use serde::Serialize;

/// Seam length at which the price of a further seam begins to fall, in square roots of the area.
pub const FIRST_SEAM: f64 = 0.5;
/// Seam length that costs as much as a further chart, in square roots of the area.
pub const PER_CHART: f64 = 0.1;
/// Weight of the fill of a given page.
pub const GIVEN_PAGE: f64 = 1.0;
/// Weight of the mean of the fill of the square and of the best among several pages.
pub const ANY_PAGE: f64 = 2.0;

/// Returns the part of the cost that seams cause: ln(1/2 + S + (n − k)/10).
///
/// `seam` is S, in square roots of the area; `n_extra` is n − k, the number of charts beyond one per component.
pub fn seam_cost(seam: f64, n_extra: usize) -> f64 {
    (FIRST_SEAM + seam + PER_CHART * n_extra as f64).ln()
}

/// Cost of a layout on its page, and the terms that are not among the other figures.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct LayoutCost {
    /// Components: sets of faces connected through vertices of one position.
    pub components: usize,
    /// ln(1/2 + `seam_over_sqrt_area` + (`charts` − `components`)/10) + 1 − `pack_square`: a tenth more seam weighs as
    /// much as a tenth of fill. May be negative; null if the surface has no area.
    pub cost: Option<f64>,
}

impl LayoutCost {
    pub(super) fn new(topology: &UvTopology, seams: &Seams, packing: &Packing) -> Self {
        let components = components(topology);
        let n_extra = seams.charts.saturating_sub(components);
        let cost = |seam| seam_cost(seam, n_extra) + GIVEN_PAGE * (1.0 - packing.pack_square);
        Self {
            components,
            cost: seams.seam_over_sqrt_area.map(cost),
        }
    }
}

/// Counts the sets of faces that welded vertices connect.
fn components(topology: &UvTopology) -> usize {
    let mut vertices = UnionFind::new(topology.points.len());
    for &[a, b, c] in &topology.faces {
        vertices.unite(a, b);
        vertices.unite(b, c);
    }
    let (label, n) = vertices.labels();
    let mut is_used = vec![false; n];
    for face in &topology.faces {
        is_used[label[face[0] as usize] as usize] = true;
    }
    is_used.into_iter().filter(|used| *used).count()
}
