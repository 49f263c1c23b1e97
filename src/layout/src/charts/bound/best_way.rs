//! Where closed components are opened.

use super::pending_chart::PendingChart;
use super::quality::Bound;
use super::simplified::Simplified;
use crate::charts::chart::Chart;
use crate::charts::observer::Observer;
use rayon::prelude::*;
use unwrapd_method::numerics::vec3::distance;
use unwrapd_method::solver::Control;

/// Vertices from which on slits are tried on a simplification, and the vertices of that.
const LARGE: usize = 10_000;
const SIMPLE: usize = 2_500;

/// Boundaries that differ in length by a smaller share are the same.
const SAME: f64 = 1e-9;

/// A chart that was chosen.
pub enum Opened {
    /// Nothing is planned in it.
    Whole(Chart),
    /// With the slits that decided for it.
    Slit(Box<PendingChart>),
}

/// The charts of a surface that is opened in several ways: of each component the chart that promises to keep the bound with the
/// shortest seams.
///
/// Slits are planned in each chart as the predictor says. The best has the least length of seams times the excess that they
/// leave: a longer seam is not worse if it leaves less.
pub fn best_opened(
    mut ways: Vec<Vec<Chart>>,
    bound: &Bound,
    observer: &dyn Observer,
) -> Vec<Opened> {
    let n = ways.first().map_or(0, Vec::len);
    ways.retain(|charts| charts.len() == n);
    let mut of_each: Vec<Vec<Chart>> = (0..n).map(|_| Vec::new()).collect();
    for (place, chart) in ways.into_iter().flat_map(|way| way.into_iter().enumerate()) {
        let length = boundary_length(&chart);
        let is_same = |other: &Chart| (boundary_length(other) / length - 1.0).abs() < SAME;
        if !of_each[place].iter().any(is_same) {
            of_each[place].push(chart);
        }
    }
    let is_whole = n == 1;
    let components = of_each.into_par_iter().with_max_len(1);
    components
        .flat_map_iter(|ways| best_of(ways, is_whole, bound, observer))
        .collect()
}

/// The best of some ways to open a component. It keeps its slits if they were planned on all of its vertices and the component
/// `is_whole`: all that there is.
fn best_of(
    mut ways: Vec<Chart>,
    is_whole: bool,
    bound: &Bound,
    observer: &dyn Observer,
) -> Option<Opened> {
    if ways.len() < 2 {
        return ways.pop().map(Opened::Whole);
    }
    let tried = ways.into_par_iter().with_max_len(1).map(|chart| {
        let simple = (chart.positions.len() > LARGE)
            .then(|| Simplified::new(&chart, SIMPLE))
            .flatten();
        let is_simple = simple.is_some();
        let mut piece =
            PendingChart::unmapped(simple.map_or_else(|| chart.clone(), |simple| simple.chart));
        let price = price(&mut piece, bound, observer);
        let opened = if is_whole && !is_simple {
            Opened::Slit(Box::new(piece))
        } else {
            Opened::Whole(chart)
        };
        (price, opened)
    });
    let tried: Vec<(f64, Opened)> = tried.collect();
    let best = tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, opened)| opened)
}

/// Slits a chart until it is expected to keep the bound: the length of its seams times the excess that is left.
fn price(piece: &mut PendingChart, bound: &Bound, observer: &dyn Observer) -> f64 {
    let allowed = bound.budget() * piece.area;
    while piece.excess > allowed && observer.control() == Control::Continue {
        if !piece.cut(piece.excess > 2.0 * allowed) {
            break;
        }
        observer.worked(piece.n_faces());
    }
    let boundary = piece.chart().map_or(0.0, boundary_length);
    (boundary / 2.0 + piece.slits_length()) * piece.excess
}

fn boundary_length(chart: &Chart) -> f64 {
    let at = |v: u32| chart.positions[v as usize];
    let of_loop = |boundary: &Vec<u32>| -> f64 {
        let ends = boundary.iter().zip(boundary.iter().cycle().skip(1));
        ends.map(|(&a, &b)| distance(at(a), at(b))).sum()
    };
    chart.disk.loops.iter().map(of_loop).sum()
}
