//! Charts whose nearly straight borders become straight, along the axes.
//!
//! Artists straighten strips, belts and tubes: texels then run along them, filtering does not blur their borders, and they pack like
//! rectangles. A map of least distortion bends them a little, and the bound on the distortion leaves room to straighten them again.
//!
//! Sides are found on the border of a map (`sides`). The map is then [minimized](embed::aligned) while its sides turn to the axes. As
//! every iterate is free of flips, so is the result; one that overlaps itself is dropped. Where all sides of a chart cost more than
//! it may, those that bend least are straightened.
//!
//! A chart keeps the bound by itself, and all charts of a surface together keep it. If they cannot, those come first whose sides
//! cost least for their length. Faces may count more than others: panels do, which are straight already.
//!
//! An arc that becomes straight is longer, and a chart that alone sets the scale of a page would leave more of it empty. With
//! [`Straighten::WhereCompact`] such a chart stays as it is, and so does a flat one, which is mapped without distortion.
//!
//! Not done here: seams stay where they are.

mod sides;

use super::Bound;
use super::distortion::{stretched_area, weighted_excess};
use super::mapped::MappedChart;
use super::observer::{Observer, Watching};
use super::unfold::overlaps::overlaps;
use rayon::prelude::*;
use sides::{Side, Sides};
use unwrapd_maps::embed::{self, RestShapes, aligned};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::hull::{convex_hull, smallest_page};
use unwrapd_method::numerics::vec3::{add_scaled, area_vector, norm};
use unwrapd_method::solver::Control;

/// Mean squared deviation of a side, in radians, from which on it is bent: a texel in a thousand.
const BENT: f64 = 1e-6;

/// Additional room for a straight chart, as a share of its area. What it loses is far less than what the luck of a packing changes, and
/// far more than rounding adds to the hull of a rectangle. Not tuned.
const MORE_ROOM: f64 = 1e-3;

/// Condition on which the sides of a chart become straight, besides the bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Straighten {
    /// They stay as they are.
    Never,
    /// They do where the chart is not flat and takes no more room on the page.
    WhereCompact,
    /// They do on any page.
    WhereBounded,
}

/// Charts of a surface, some of them with straight sides.
pub struct Straightened {
    /// All charts, in the order given.
    pub charts: Vec<MappedChart>,
    /// Number of the charts that were to become straight [`WhereBounded`](Straighten::WhereBounded) and keep a bent side.
    pub n_bent: usize,
}

/// Straightens the sides of some charts of a surface under a bound, which those charts then keep together if they kept it before.
/// `weights` says for each face of the surface how often its distortion counts. Maps keep their sizes.
pub fn straightened(
    charts: Vec<MappedChart>,
    condition: &(dyn Fn(&MappedChart) -> Straighten + Sync),
    weights: &[f64],
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Straightened {
    let of_all = Page {
        all_area: charts.iter().map(MappedChart::surface_area).sum(),
        is_alone: charts.len() == 1,
    };
    let mut attempts: Vec<Option<StraightChart>> = (charts.par_iter().with_max_len(1))
        .map(|chart| {
            let page = match condition(chart) {
                Straighten::Never => return None,
                Straighten::WhereCompact if is_flat(chart) => return None,
                Straighten::WhereCompact => Some(of_all),
                Straighten::WhereBounded => None,
            };
            StraightChart::new(chart, weights, page, bound, options, observer)
        })
        .collect();
    // Spend what the bound leaves where a length of straight border costs least.
    let all = attempts.iter().flatten();
    let mut left: f64 = all.map(|it| bound.budget() * it.area - it.excess).sum();
    let price = |chart: usize| attempts[chart].as_ref().and_then(StraightChart::price);
    let mut order: Vec<(f64, usize)> = (0..charts.len())
        .filter_map(|chart| Some((price(chart)?, chart)))
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut charts = charts;
    for (_, chart) in order {
        let Some(attempt) = &mut attempts[chart] else {
            continue;
        };
        if let Some(straight) = attempt.straight.take()
            && straight.cost <= left.max(0.0)
        {
            attempt.n_bent -= straight.n_sides;
            left -= straight.cost;
            let size = (charts[chart].area() / charts[chart].surface_area()).sqrt();
            charts[chart] = straight.chart;
            if size.is_normal() {
                for p in &mut charts[chart].embedding.uv {
                    *p = p.map(|x| size * x);
                }
            }
        }
    }
    // An attempt without a page is one on any page.
    let is_bent = |attempt: &&StraightChart| attempt.page.is_none() && 0 < attempt.n_bent;
    Straightened {
        n_bent: attempts.iter().flatten().filter(is_bent).count(),
        charts,
    }
}

/// A chart, and its map with straight sides if there is one.
struct StraightChart {
    rest: RestShapes,
    /// For each face how often its excess counts.
    factors: Vec<f64>,
    area: f64,
    excess: f64,
    /// The page, and its largest area; `None` if any page will do.
    page: Option<(Page, f64)>,
    /// Number of bent sides.
    n_bent: usize,
    straight: Option<Straight>,
}

/// A map with straight sides, at the size of the surface.
struct Straight {
    chart: MappedChart,
    /// Additional excess.
    cost: f64,
    /// Number of the sides that became straight, and their length.
    n_sides: usize,
    length: f64,
}

impl StraightChart {
    /// Returns the attempt at one chart; `None` if its map has no area. `page` is that of the surface, if it must not grow.
    fn new(
        mapped: &MappedChart,
        weights: &[f64],
        page: Option<Page>,
        bound: &Bound,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Option<Self> {
        let corners = mapped.chart.corners.iter();
        let factors: Vec<f64> = corners.map(|[c, ..]| weights[*c as usize / 3]).collect();
        let rest = mapped.rest_shapes();
        // Given maps may have any size.
        let size = (mapped.surface_area() / mapped.area()).sqrt();
        if !size.is_normal() {
            return None;
        }
        let mut sized = mapped.clone();
        for p in &mut sized.embedding.uv {
            *p = p.map(|x| size * x);
        }
        let [excess, area] = weighted_excess(&sized, &rest, &factors);
        let page = page.map(|page| {
            let most = page.around(&sized) + MORE_ROOM * sized.area();
            (page, most)
        });
        let mut attempt = Self {
            rest,
            factors,
            area,
            excess,
            page,
            n_bent: 0,
            straight: None,
        };
        attempt.straighten(&sized, bound, options, observer);
        Some(attempt)
    }

    /// Finds the map with the most straight sides that keeps the bound, the least bent first.
    fn straighten(
        &mut self,
        mapped: &MappedChart,
        bound: &Bound,
        options: &embed::Options,
        observer: &dyn Observer,
    ) {
        let Some(sides) = Sides::of(&mapped.chart, &mapped.embedding.uv) else {
            return;
        };
        let options = embed::Options {
            weights: self.factors.clone(),
            ..options.clone()
        };
        let is_bent = |side: &Side| side.deviation > BENT;
        // Sides are in the order of their deviations: search for the number of them that can be straight.
        let mut kept = sides.sides.iter().take_while(|side| !is_bent(side)).count();
        let mut most = sides.sides.len();
        self.n_bent = most - kept;
        let mut n = most;
        while kept < most && observer.control() != Control::Finish {
            let chosen = &sides.sides[..n];
            let map = straight(mapped, sides.axis, chosen, &options, observer);
            match map.and_then(|map| self.excess_within(&map, bound).map(|excess| (map, excess))) {
                Some((chart, excess)) => {
                    kept = n;
                    let bent = || chosen.iter().filter(|side| is_bent(side));
                    self.straight = Some(Straight {
                        chart,
                        cost: excess - self.excess,
                        n_sides: bent().count(),
                        length: bent().map(|side| side.length).sum(),
                    });
                }
                None => most = n - 1,
            }
            n = usize::midpoint(kept, most + 1);
        }
    }

    /// Returns the excess of a map of the chart that keeps the bound and the page, has no flip and does not overlap itself.
    fn excess_within(&self, mapped: &MappedChart, bound: &Bound) -> Option<f64> {
        let uv = &mapped.embedding.uv;
        let disk = &mapped.chart.disk;
        if !embed::is_positive(&disk.triangles, uv) {
            return None;
        }
        let [excess, area] = weighted_excess(mapped, &self.rest, &self.factors);
        let keeps_stretch = bound.stretch.is_none_or(|most| {
            let [stretched, most_stretched] = [
                stretched_area(mapped, &self.rest, most),
                Bound::stretched_budget() * area,
            ];
            stretched <= most_stretched
        });
        let keeps_page =
            (self.page).is_none_or(|(page, most)| page.around_straight(mapped) <= most);
        let is_within = excess <= bound.budget() * area && keeps_stretch && keeps_page;
        (is_within && overlaps(disk, uv).is_empty()).then_some(excess)
    }

    /// Returns the cost of a length of straight border; `None` without a straight map.
    fn price(&self) -> Option<f64> {
        self.straight.as_ref().map(|map| map.cost / map.length)
    }
}

/// Returns whether a chart lies in a plane: its normals deviate from their mean by at most [`BENT`].
fn is_flat(mapped: &MappedChart) -> bool {
    let corners = |t: &[u32; 3]| t.map(|v| mapped.chart.positions[v as usize]);
    let triangles = mapped.chart.disk.triangles.iter().map(corners);
    let sum = triangles.fold([0.0; 3], |sum, [a, b, c]| {
        add_scaled(sum, 0.5, area_vector(a, b, c))
    });
    2.0 * (1.0 - norm(sum) / mapped.surface_area()) <= BENT
}

/// The square page of the charts of a surface, which holds them and the gaps between one of them and its convex hull.
#[derive(Clone, Copy)]
struct Page {
    /// Area of the charts.
    all_area: f64,
    /// `true` if there is one chart. The packer lays it along the axes once it is straight.
    is_alone: bool,
}

impl Page {
    /// Returns the least area of the page for a chart at any angle.
    fn around(&self, mapped: &MappedChart) -> f64 {
        let hull = convex_hull(mapped.embedding.uv.iter().copied());
        self.with_gaps(mapped, &hull)
            .max(smallest_page(&hull, 1.0).area)
    }

    /// Returns the least area of the page for a chart whose sides lie along the axes.
    fn around_straight(&self, mapped: &MappedChart) -> f64 {
        if !self.is_alone {
            return self.around(mapped);
        }
        let hull = convex_hull(mapped.embedding.uv.iter().copied());
        let [low, high] = bounds_of(&hull);
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        self.with_gaps(mapped, &hull).max(side * side)
    }

    /// Returns the area of the charts and of the gaps between one of them and its hull.
    fn with_gaps(&self, mapped: &MappedChart, hull: &[[f64; 2]]) -> f64 {
        let next = hull.iter().cycle().skip(1);
        let doubled = hull
            .iter()
            .zip(next)
            .map(|(p, q)| p[0] * q[1] - p[1] * q[0]);
        self.all_area + doubled.sum::<f64>() / 2.0 - mapped.area()
    }
}

/// Straightens some sides of a chart whose first axis is given as a unit vector. Returns `None` if a side stays bent.
fn straight(
    mapped: &MappedChart,
    [c, s]: [f64; 2],
    sides: &[Side],
    options: &embed::Options,
    observer: &dyn Observer,
) -> Option<MappedChart> {
    let chart = &mapped.chart;
    let turned = |p: &[f64; 2]| [c * p[0] + s * p[1], c * p[1] - s * p[0]];
    let start: Vec<[f64; 2]> = mapped.embedding.uv.iter().map(turned).collect();
    let edges: Vec<([u32; 2], usize)> = (sides.iter())
        .flat_map(|side| side.edges.iter().map(|&edge| (edge, side.coordinate)))
        .collect();
    let watching = Watching { chart, observer };
    let embedding = aligned(
        &chart.disk,
        &chart.positions,
        &start,
        &edges,
        options,
        &watching,
    )
    .ok()?;
    // Sides that the barrier keeps from their axes are not straight.
    let is_straight = |side: &Side| side.deviation_in(&embedding.uv) <= BENT;
    sides.iter().all(is_straight).then(|| MappedChart {
        embedding: embed::Embedding {
            summary: mapped.embedding.summary.followed_by(&embedding.summary),
            ..embedding
        },
        ..mapped.clone()
    })
}
