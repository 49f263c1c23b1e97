//! One search for where to cut a surface, which grows beside the cutters of [`charts`](crate::charts).
//!
//! A *net* is a set of faces with its slits and its map. The search minimizes
//!
//! ```text
//! S + n/10   subject to   ∫ (E − 4) ≤ bound
//! ```
//!
//! S is the length of the seams, n the number of nets and E the symmetric Dirichlet energy of their maps, in units in which
//! the surface has area 1: what the [cost of a layout](unwrapd_maps::measure::cost) asks of its seams. It knows no classes
//! of surfaces. Distortion has a price λ that falls from strict to loose, so what the bound allows is spent where it saves
//! the most seam. At each price
//!
//! 1. neighbors are *glued*, best first (`glue`): with no cut between them, which unites tubes; with the slits that both have;
//!    or at a hinge, one stretch of their border, which makes the nets of polyhedra;
//! 2. slits are *given back*, whole or by half (`reopen`).
//!
//! To each of these ways, slits are added while they pay (`opening`), by a prediction of the distortion that needs no map
//! (`prediction`). Only ways that promise to pay are mapped (`net`), from the maps of the parts where these can be laid
//! together (`laid_together`). A map that flips or overlaps, and cannot be pushed apart, rejects the way.
//!
//! On panels the excess counts 16 times, in the map, the prediction and the bound (`panels`): they stay straight, and what is round
//! beside them takes the distortion. The bound on this weighted mean is one on the plain mean as well.
//!
//! The search starts from facets, joined while they stay nearly developable (`pieces`), or from given charts.
//!
//! Every face is in exactly one net, and every net is a disk, possibly with holes, whose map has neither flips nor overlaps.
//! Not done here: cuts for fill, symmetry, other starts for surfaces of many faces, on which predictions take long.
mod cut_mesh;
mod glue;
mod laid_together;
mod metric;
mod net;
mod nets;
mod opening;
mod panels;
mod pieces;
mod prediction;
mod reopen;
mod sets;
mod state;

use crate::charts::{Bound, MappedChart, Observer};
use metric::Metric;
use net::Net;
use nets::Nets;
use panels::{PANEL_FACTOR, panels};
pub use state::Counts;
use state::Search;
use unwrapd_maps::embed;
use unwrapd_maps::mesh::Surface;

/// Prices of the excess, one pass each, from pieces: strict ones make nets of what is flat, loose ones spend the bound. Steps
/// of 2 instead of 4 give 4 to 7 % less seam for 1.3 times the time.
const FROM_PIECES: [f64; 5] = [128.0, 32.0, 8.0, 2.0, 0.5];
/// Prices of the excess from charts that are nearly as distorted as they may be. Steps of 2 give the same seam for half as
/// much time again; without 32, 46 charts of an asset of small flat parts stay instead of 39.
const FROM_CHARTS: [f64; 4] = [32.0, 8.0, 2.0, 0.5];

/// Divides a surface into charts that keep a bound on the mean energy, starting from pieces that are nearly developable.
///
/// Returns the charts and the work that it took. The bound is exceeded only if the pieces exceed it: then nothing is glued that
/// adds to the excess.
pub fn from_pieces(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let metric = weighted(surface);
    let nets = Nets::new(&metric, Vec::new());
    let mut search = Search::new(nets, bound.budget(), options, observer);
    search.start(FROM_PIECES[0]);
    search.run(&FROM_PIECES);
    finished(&search)
}

/// Glues given charts and gives slits back as long as the charts keep a bound on the mean energy.
///
/// The charts hold every face of the surface once. Returns charts whose seams cost at most as much, and the work that it
/// took; charts over the bound stay as they are.
pub fn from_charts(
    surface: &Surface,
    charts: &[MappedChart],
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let metric = weighted(surface);
    let nets = charts.iter().map(|chart| Net::of_chart(&metric, chart));
    let nets = Nets::new(&metric, nets.collect());
    let mut search = Search::new(nets, bound.budget(), options, observer);
    search.run(&FROM_CHARTS);
    finished(&search)
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

fn finished(search: &Search) -> (Vec<MappedChart>, Counts) {
    let nets = search.nets.list.values();
    let charts = nets.filter_map(|net| net.mapped_chart(search.nets.metric));
    (charts.collect(), search.counts)
}
