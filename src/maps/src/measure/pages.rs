//! Contents of the pages of an atlas.

use super::faces::FaceMeasures;
use crate::certificate::UvTopology;
use serde::Serialize;
use std::collections::BTreeMap;

/// One page: a unit square of UV space that holds charts.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Page {
    /// Its number as a tile of UDIM, 1001 + u + 10 v with the u and v, up, of its lower left corner.
    pub udim: u32,
    /// Charts with the middle of their UVs on it.
    pub charts: usize,
    /// Their area over that of the page.
    pub fill: f64,
}

/// Most tiles in a row, and most rows: their numbers, 1001 + u + 10 v, have four digits.
const TILES: i64 = 10;
const ROWS: i64 = 899;

/// Returns the pages on which charts lie, in the order of their numbers; charts outside all tiles are left out.
///
/// `up` turns a v of the file into one that points up.
pub(super) fn pages(
    topology: &UvTopology,
    faces: &FaceMeasures,
    aspect: f64,
    up: impl Fn(f64) -> f64,
) -> Vec<Page> {
    // Find the bounds of each chart.
    let mut bounds = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; faces.charts.len()];
    for (corners, &chart) in topology.uvs.iter().zip(&topology.charts.of_face) {
        let [low, high] = &mut bounds[chart as usize];
        for uv in corners {
            for axis in 0..2 {
                low[axis] = low[axis].min(uv[axis]);
                high[axis] = high[axis].max(uv[axis]);
            }
        }
    }
    // Count each chart on the page that holds the middle of its bounds.
    let mut pages: BTreeMap<u32, (usize, f64)> = BTreeMap::new();
    for (chart, [low, high]) in faces.charts.iter().zip(bounds) {
        let middle = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
        let (u, v) = (
            (middle[0] / aspect).floor() as i64,
            up(middle[1]).floor() as i64,
        );
        if chart.is_real() && (0..TILES).contains(&u) && (0..ROWS).contains(&v) {
            let page = pages.entry((1001 + u + TILES * v) as u32).or_default();
            *page = (page.0 + 1, page.1 + chart.area_uv / aspect);
        }
    }
    let listed = pages.into_iter();
    listed
        .map(|(udim, (charts, fill))| Page { udim, charts, fill })
        .collect()
}
