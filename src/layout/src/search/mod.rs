//! One search for where to cut a surface, which improves what the cutters of [`charts`](crate::charts) make, or starts anew.
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
//! together (`laid_together`); parts that collide are not mapped. A map that flips or overlaps, and cannot be pushed apart, rejects
//! the way. Moves wait in one queue, the one that gains most for its work first, until the effort is spent (`effort`).
//!
//! On panels the excess counts 16 times, in the map, the prediction and the bound (`panels`): they stay straight, and what is round
//! beside them takes the distortion. The bound on this weighted mean is one on the plain mean as well.
//!
//! Lengths and whatever else decides are rounded, so that parts that are alike tie, and the order of the faces decides between them,
//! not the rounding of their vertices ([`tied`](unwrapd_method::numerics::ties::tied)): pose, scale and digits seldom change the cut.
//!
//! The search starts from given charts, or from the components of the surface, each slit open (`slitting`), if these cost less; or from
//! facets, joined while they stay nearly developable (`pieces`).
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
mod slitting;
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
use unwrapd_method::solver::Control;

/// Prices of the excess, one pass each, from pieces: strict ones make nets of what is flat, loose ones spend the bound. Steps
/// of 2 instead of 4 give 4 to 7 % less seam for 1.3 times the time.
const FROM_PIECES: [f64; 5] = [128.0, 32.0, 8.0, 2.0, 0.5];
/// Prices of the excess from charts that are cut already. A third price of 0.5 leaves each less of the effort: seams and charts cost
/// 5 % more on ten machine parts and game assets (`cargo bench -p unwrapd-layout --bench search`).
const FROM_CHARTS: [f64; 2] = [8.0, 2.0];

/// Cost that cuts alike on both sides of a mirror plane are worth. Not tuned: about a tenth of the seams.
const SYMMETRY: f64 = 0.1;

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

/// Glues charts and gives slits back as long as the charts keep a bound on the mean energy; slits charts that break it.
///
/// The search starts from given charts, which hold every face of the surface once, or from its components slit open if these cost less.
/// It takes the share of the effort that the charts leave of the bound, or that panels have of the area: bent parts without much of the
/// bound left have little to gain. It takes all of the effort if the charts break the bound.
///
/// Returns the charts, and the work that the search took. If the given charts kept the bound, those returned cost at most as much.
/// Charts that no move changed stay as they are; so do all if the stretch is bounded, which the search does not measure.
pub fn from_charts(
    surface: &Surface,
    charts: Vec<MappedChart>,
    bound: &Bound,
    terms: &Terms,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    if bound.stretch.is_some() || observer.control() == Control::Finish {
        return (charts, Counts::new(terms.effort.share(0.0)));
    }
    let metric = weighted(surface);
    let is_measured = !is_of_smoothed(bound, surface);
    let slit = is_measured.then(|| slit_open(&metric, &charts, bound, terms, options, observer));
    let (charts, effort) = slit.flatten().unwrap_or((charts, terms.effort));
    let nets = charts.iter().map(|chart| Net::of_chart(&metric, chart));
    let nets = Nets::new(&metric, nets.collect());
    let unspent = 1.0 - nets.excess() / bound.budget().max(f64::MIN_POSITIVE);
    let share = if is_measured && is_broken(&charts, bound) {
        1.0
    } else {
        unspent.max(share_of_panels(&metric))
    };
    let effort = effort.share(share);
    let smallest = charts.iter().map(|map| map.chart.corners.len()).min();
    if smallest.is_none_or(|faces| effort.most < faces as f64) {
        return (charts, Counts::new(effort));
    }
    let terms = Terms { effort, ..*terms };
    let mut search = Search::new(nets, bound.budget(), &terms, options, observer);
    search.run(&FROM_CHARTS);
    // Nets are numbered in the order of the charts; changed ones have later numbers.
    let found = search.nets.list.iter();
    let found = found.filter_map(|(&number, net)| match charts.get(number as usize) {
        Some(chart) => Some(chart.clone()),
        None => net.mapped_chart(&metric),
    });
    (found.collect(), search.counts)
}

/// Slits the components of a surface open until they keep a bound on the mean energy.
///
/// Returns the charts, and the effort that is left, if they [cost](unwrapd_maps::measure::cost) less than `rival`, other charts of the surface,
/// or only they keep the bound. Charts that are cut alike on both sides of a plane give way only to much cheaper ones. Where panels are
/// so small that their share of the effort is not one map, nothing is tried: the cutters have slit such a surface open already.
fn slit_open(
    metric: &Metric,
    rival: &[MappedChart],
    bound: &Bound,
    terms: &Terms,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Option<(Vec<MappedChart>, Effort)> {
    if terms.effort.share(share_of_panels(metric)).most < metric.corners.len() as f64 {
        return None;
    }
    let nets = rival.iter().map(|chart| Net::of_chart(metric, chart));
    let nets = Nets::new(metric, nets.collect());
    let most = if is_broken(rival, bound) {
        f64::INFINITY
    } else if is_symmetric(rival) {
        nets.cost(terms.fill_weight) - SYMMETRY
    } else {
        nets.cost(terms.fill_weight)
    };
    let nets = Nets::new(metric, Vec::new());
    let mut search = Search::new(nets, bound.budget(), terms, options, observer);
    search.start_from_components(most)?;
    let charts = search.nets.list.values();
    let charts: Vec<MappedChart> = charts.filter_map(|net| net.mapped_chart(metric)).collect();
    let is_better = search.nets.cost(terms.fill_weight) < most && !is_broken(&charts, bound);
    is_better.then(|| (charts, search.counts.effort.left()))
}

/// Returns the share of the area that lies on panels.
fn share_of_panels(metric: &Metric) -> f64 {
    let faces = metric.weight.iter().zip(&metric.area);
    let panels = faces.filter(|(weight, area)| weight > area);
    panels.map(|(_, area)| area).sum()
}

/// Returns whether most of the area of some charts is cut alike on both sides of a plane.
fn is_symmetric(charts: &[MappedChart]) -> bool {
    let (mut symmetric, mut area) = (0.0, 0.0);
    for map in charts {
        let own = map.surface_area();
        area += own;
        if map.chart.mirror.is_some() {
            symmetric += own;
        }
    }
    symmetric > 0.5 * area
}

/// Returns whether a bound is on the surface that a rough one is a sample of, whose distortion the search does not measure.
fn is_of_smoothed(bound: &Bound, surface: &Surface) -> bool {
    bound.of == Bounded::Smoothed && smoothed_where_rough(surface).is_some()
}

/// Returns whether the mean energy of charts exceeds a bound.
fn is_broken(charts: &[MappedChart], bound: &Bound) -> bool {
    let mut sum = [0.0; 2];
    for chart in charts {
        let [excess, area] = excess_and_area(chart, &chart.rest_shapes());
        sum = [sum[0] + excess, sum[1] + area];
    }
    sum[0] > (bound.mean - 4.0) * sum[1]
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
