//! Expected fill of an atlas, from its charts alone.

use super::objective::Pages;
use unwrapd_layout::charts::MappedChart;
use unwrapd_method::numerics::hull::{convex_hull, smallest_page};
use unwrapd_method::numerics::support::{Directions, Support};

/// Coefficients of the fill: per area of the hulls; per excess of the largest page around a chart over a limit; and
/// per root of the sum of squared areas and per sum of areas to the power 3/2, which are small if charts are many and
/// alike. All areas are shares of the area of all charts.
///
/// Fitted by least squares to 903 layouts of the charts of 58 meshes, to differences within each mesh: the root mean square
/// error is 0.028, part of it the luck of a short search.
const PER_HULL: f64 = -0.1;
const PER_EXCESS: f64 = -0.058;
const LARGEST_PAGE: f64 = 1.2;
const PER_ROOT_OF_SQUARES: f64 = 1.569;
const PER_SUM_OF_POWERS: f64 = -1.906;

/// Area of a chart, of its convex hull and of the smallest pages around it.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    area: f64,
    hull: f64,
    /// Area of the smallest page of each shape around it: 1:1, 2:1, 4:1 and 8:1.
    pages: [f64; 4],
}

impl Extent {
    pub fn of(chart: &MappedChart) -> Self {
        let directions = Directions::default();
        let mut support = Support::EMPTY;
        for &p in &chart.embedding.uv {
            support.add(p, &directions);
        }
        let hull = convex_hull(chart.embedding.uv.iter().copied());
        Self {
            area: chart.area(),
            hull: support.area(),
            pages: [1.0, 2.0, 4.0, 8.0].map(|aspect| smallest_page(&hull, aspect).area),
        }
    }
}

/// Returns the share of the page that a layout of these charts fills, up to a constant that does not depend on the cuts: the mean of the
/// square and the best of the pages if there are several.
pub fn expected_fill(extents: &[Extent], pages: Pages) -> f64 {
    let sum = |of: &dyn Fn(&Extent) -> f64| extents.iter().map(of).sum::<f64>();
    let area = sum(&|e| e.area).max(f64::MIN_POSITIVE);
    let shapes = match pages {
        Pages::Given => 1,
        Pages::Any => 4,
    };
    let around = |shape: usize| extents.iter().map(|e| e.pages[shape]).fold(0.0, f64::max);
    let best = (0..shapes).map(around).fold(f64::INFINITY, f64::min);
    let excess = |largest: f64| (largest / area - LARGEST_PAGE).max(0.0);
    let share = |e: &Extent| e.area / area;
    PER_HULL * sum(&|e| e.hull) / area
        + PER_EXCESS * f64::midpoint(excess(around(0)), excess(best))
        + PER_ROOT_OF_SQUARES * sum(&|e| share(e).powi(2)).sqrt()
        + PER_SUM_OF_POWERS * sum(&|e| share(e) * share(e).sqrt())
}
