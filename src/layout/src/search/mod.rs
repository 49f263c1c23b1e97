//! One search for where to cut a surface, which improves what the cutters of [`charts`](crate::charts) make.
//!
//! A *net* is a set of faces with its slits and its map. The search lowers
//!
//! ```text
//! ln(1/2 + S + n/10) + w (1 − F)   subject to   ∫ (E − 4) ≤ bound
//! ```
//!
//! S is the length of the seams, n the number of nets and E the symmetric Dirichlet energy of their maps, in units in which
//! the surface has area 1. F estimates the fill of a square page, less than usual if one net alone sets the scale; w is its
//! weight. This is the [cost of a layout](unwrapd_maps::measure::cost) as far as it is known before packing. The search knows
//! no classes of surfaces. Distortion has a price λ that falls from strict to loose, so what the bound allows is spent where it
//! saves the most seam.
//!
//! A move opens the faces of one net, or of two neighbors, in another way (`moves`):
//!
//! - Neighbors are *glued*: with no cut between them, which unites tubes; with the slits that both have; or at a hinge, one
//!   stretch of their border, which makes the nets of polyhedra.
//! - Slits of a net are *given back*, whole or by half.
//! - While the bound is broken, nets without slits are slit.
//!
//! To each of these ways, slits are added while they pay (`opening`), by a prediction of the distortion that needs no map
//! (`prediction`). Only ways that promise to pay are mapped (`net`), from the maps of the parts where these can be laid
//! together (`laid_together`). A map that flips or overlaps, and cannot be pushed apart, rejects the way. Moves wait in one queue, the
//! one that gains most for its work first, until the effort is spent (`effort`).
//!
//! On panels the excess counts 16 times, in the map, the prediction and the bound (`panels`): they stay straight, and what is round
//! beside them takes the distortion. The bound on this weighted mean is one on the plain mean as well.
//!
//! Lengths and whatever else decides are rounded, so that parts that are alike tie, and the order of the faces decides between them,
//! not the rounding of their vertices ([`tied`](unwrapd_method::numerics::ties::tied)): pose, scale and digits seldom change the cut.
//!
//! The search starts from given charts, or from facets, joined while they stay nearly developable (`pieces`).
//!
//! Every face is in exactly one net, and every net is a disk, possibly with holes, whose map has neither flips nor overlaps.
//! Not done here: cuts for fill, symmetry, a bound on the stretch.
mod cut_mesh;
mod effort;
mod laid_together;
mod metric;
mod moves;
mod net;
mod nets;
mod opening;
mod panels;
mod pieces;
mod prediction;
mod sets;
mod state;

use crate::charts::{Bound, Bounded, MappedChart, Observer, excess_and_area, smoothed_where_rough};
pub use effort::Effort;
use metric::Metric;
use net::Net;
use nets::Nets;
use panels::{PANEL_FACTOR, panels};
pub use state::Counts;
use state::Search;
use unwrapd_maps::embed;
use unwrapd_maps::measure::cost::GIVEN_PAGE;
use unwrapd_maps::mesh::Surface;

/// Prices of the excess, one pass each, from pieces: strict ones make nets of what is flat, loose ones spend the bound. Steps
/// of 2 instead of 4 give 4 to 7 % less seam for 1.3 times the time.
const FROM_PIECES: [f64; 5] = [128.0, 32.0, 8.0, 2.0, 0.5];
/// Prices of the excess from charts that are cut already. A third price of 0.5 leaves each less of the effort: seams and charts cost
/// 5 % more on ten machine parts and game assets (`cargo bench --bench search`).
const FROM_CHARTS: [f64; 2] = [8.0, 2.0];

/// Terms of a search.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// The most work that may be done.
    pub effort: Effort,
    /// Weight of the fill of a square page beside the cost of the seams: 1 over the weight of a seam.
    pub fill_weight: f64,
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            effort: Effort::UNBOUNDED,
            fill_weight: GIVEN_PAGE,
        }
    }
}

/// Divides a surface into charts that keep a bound on the mean energy, starting from pieces that are nearly developable.
///
/// Returns the charts and the work that it took. The bound is exceeded only if the pieces exceed it: then nothing is glued that
/// adds to the excess. The fill of the page does not count.
pub fn from_pieces(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let metric = weighted(surface);
    let nets = Nets::new(&metric, Vec::new());
    let terms = Terms {
        fill_weight: 0.0,
        ..Terms::default()
    };
    let mut search = Search::new(nets, bound.budget(), &terms, options, observer);
    search.start(FROM_PIECES[0]);
    search.run(&FROM_PIECES);
    let nets = search.nets.list.values();
    let charts = nets.filter_map(|net| net.mapped_chart(&metric));
    (charts.collect(), search.counts)
}

/// Glues given charts and gives slits back as long as the charts keep a bound on the mean energy; slits charts that break it.
///
/// The charts hold every face of the surface once. Of the effort the search takes the share of the bound that the charts leave
/// unspent, since the rest of them has little to gain, and all of it if they break the bound. Returns the charts, and the work that it
/// took. If the bound was kept, their seams cost at most as much as before. Charts that no move changed stay as they are; so do all if
/// the stretch is bounded, which the search does not measure.
pub fn from_charts(
    surface: &Surface,
    charts: Vec<MappedChart>,
    bound: &Bound,
    terms: &Terms,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let budget = bound.budget();
    // If what is left is too little for the smallest chart, even without panels, the search needs no arrays.
    let smallest = charts.iter().map(|map| map.chart.corners.len()).min();
    let excess = mean_excess(&charts);
    let is_broken = excess > bound.mean - 4.0 && !is_of_smoothed(bound, surface);
    let effort = terms
        .effort
        .share(share_of_effort(is_broken, excess, budget));
    if bound.stretch.is_some() || smallest.is_none_or(|faces| effort.most < faces as f64) {
        return (charts, Counts::new(effort));
    }
    let metric = weighted(surface);
    let nets = charts.iter().map(|chart| Net::of_chart(&metric, chart));
    let nets = Nets::new(&metric, nets.collect());
    let terms = Terms {
        effort: (terms.effort).share(share_of_effort(is_broken, nets.excess(), budget)),
        ..*terms
    };
    let mut search = Search::new(nets, budget, &terms, options, observer);
    search.run(&FROM_CHARTS);
    // Nets are numbered in the order of the charts; changed ones have later numbers.
    let found = search.nets.list.iter();
    let found = found.filter_map(|(&number, net)| match charts.get(number as usize) {
        Some(chart) => Some(chart.clone()),
        None => net.mapped_chart(&metric),
    });
    (found.collect(), search.counts)
}

/// Returns the share of the effort for charts: what they leave of the bound, or all if they break it.
fn share_of_effort(is_broken: bool, excess: f64, budget: f64) -> f64 {
    if is_broken {
        1.0
    } else {
        (1.0 - excess / budget.max(f64::MIN_POSITIVE)).max(0.0)
    }
}

/// Returns whether a bound is on the surface that a rough one is a sample of, whose distortion the search does not measure.
fn is_of_smoothed(bound: &Bound, surface: &Surface) -> bool {
    bound.of == Bounded::Smoothed && smoothed_where_rough(surface).is_some()
}

/// Returns the excess of charts over an energy of 4, per area.
fn mean_excess(charts: &[MappedChart]) -> f64 {
    let mut sum = [0.0; 2];
    for chart in charts {
        let [excess, area] = excess_and_area(chart, &chart.rest_shapes());
        sum = [sum[0] + excess, sum[1] + area];
    }
    sum[0] / sum[1].max(f64::MIN_POSITIVE)
}

/// Measures a surface; the excess on its panels counts [several times](PANEL_FACTOR).
fn weighted(surface: &Surface) -> Metric<'_> {
    let mut metric = Metric::new(surface);
    let is_panel = panels(&metric);
    for (weight, _) in metric.weight.iter_mut().zip(is_panel).filter(|(_, it)| *it) {
        *weight *= PANEL_FACTOR;
    }
    metric
}
