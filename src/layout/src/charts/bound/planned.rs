//! The seams of a large chart, planned on a simplification of it.

use super::pending_chart::PendingChart;
use super::quality::Bound;
use super::redrawn::parted_along;
use super::rounds::{mean_excess, rounds};
use super::simplified::Simplified;
use crate::charts::chart::Chart;
use crate::charts::give_back::given_back::given_back;
use crate::charts::mapped::MappedChart;
use crate::charts::observer::{Observer, Planning};
use unwrapd_maps::embed;

/// The vertices of the simplification.
const SIMPLE: usize = 10_000;

/// The share of the bound that a plan may leave unspent.
const MOST_UNSPENT: f64 = 0.3;

/// How far a seam of the simplification may move when it is drawn on the chart, in edges of the simplification.
const EDGES_OFF: usize = 2;

/// The charts into which a chart is parted as its simplification is so that it keeps the bound: large charts are mapped once or twice,
/// not in every round.
pub fn parted_as_simplified(
    chart: Chart,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<Chart> {
    let Some(simple) = Simplified::new(&chart, SIMPLE) else {
        return vec![chart];
    };
    let planning = Planning {
        observer,
        faces: simple.faces(&chart),
    };
    let planned = planned(&simple, bound, options, &planning);
    let edges = simple.carried_back(planned.iter().map(|map| &map.chart));
    let share = chart.positions.len() as f64 / simple.chart.positions.len() as f64;
    let an_edge = share.sqrt().ceil() as usize;
    parted_along(&chart, |edge| edges.contains(&edge), EDGES_OFF * an_edge)
}

/// The parts of a simplified chart that keep the bound. Where slits helped more than was expected of them, a second plan has fewer.
fn planned(
    simple: &Simplified,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    let under = |bound: &Bound| {
        let whole = vec![PendingChart::unmapped(simple.chart.clone())];
        let pieces = rounds(whole, bound, options, observer);
        // Only the parts of the chart itself count.
        let n_mapped = pieces.len() as isize;
        observer.charted(-n_mapped, -n_mapped);
        pieces
    };
    let mut pieces = under(bound);
    let unspent = bound.budget() - mean_excess(&pieces);
    if unspent > MOST_UNSPENT * bound.budget() {
        let fewer = under(&Bound {
            mean: bound.mean + unspent,
            ..*bound
        });
        if mean_excess(&fewer) <= bound.budget() {
            pieces = fewer;
        }
    }
    let parts = PendingChart::maps(pieces).collect();
    match simple.surface() {
        Some(surface) => given_back(&surface, parts, bound, options, observer),
        None => parts,
    }
}
