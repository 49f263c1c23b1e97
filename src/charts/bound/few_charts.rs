//! Few charts under a bound on their distortion.

use super::distortion::stretched_area;
use super::pending_chart::Piece;
use super::quality::Bound;
use super::simplified::Simplified;
use super::slits::Slits;
use crate::charts::chart::{Chart, Cut, charts};
use crate::charts::give_back::given_back::given_back;
use crate::charts::mapped::{Folds, MappedChart, Observer, map_chart};
use crate::embed::{self, is_needle};
use crate::mesh::Surface;
use crate::numerics::vec3::{area_vector, norm};
use crate::solver::Control;
use rayon::prelude::*;

/// What each round promises of what the one before promised.
const PROMISE: f64 = 0.95;

/// Triangles up to which the next round goes half of the way to the bound: slits gain more than is expected of them, and of what is
/// too much nothing comes back. With more of them a round costs seconds.
const PATIENT: usize = 30_000;

/// Triangles of a chart from which on its first slits are planned on a simplification, and the vertices of that.
const LARGE: usize = 60_000;
const SIMPLE: usize = 10_000;

/// The share of the mean excess that is aimed at where the stretch is too large.
const TIGHTER: f64 = 0.7;

/// Rounds of cutting and mapping at most. One to three are the rule.
const MOST_ROUNDS: usize = 8;

/// A round that leaves more than this share of the excess, and that many times more than there may be, shows that slits do
/// not help: a sponge of a thousand handles stays one.
const HOPELESS: [f64; 2] = [0.7, 4.0];

/// Newton steps at most on a chart of needles, which go on for hundreds without gaining a shape.
const STEPS_FOR_NEEDLES: usize = 10;

/// The charts of a surface, mapped, whose mean symmetric Dirichlet energy keeps the bound where that can be had.
///
/// Each component is opened to a disk; disks are slit where the predictor says that they would be distorted most, until the sum
/// promises to keep the bound; then they are mapped, parted where a map overlaps itself, and slit further where the maps were
/// worse than promised. The bound is one for all charts: a slit is spent where the excess is largest. Where the stretch is too
/// large the same goes on as for a smaller mean. A surface on which this does not lead below the bound is divided as by
/// [`Cut::Fast`] if that does better. At last small charts are [given back](given_back). A surface of needles, of which no map keeps the
/// shape, is not slit.
pub fn charts_under_bound(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    if is_mostly_needles(surface) {
        let mut options = *options;
        options.solver.max_iterations = STEPS_FOR_NEEDLES;
        return map_all(charts(surface, Cut::Disk), &options, observer);
    }
    let slit = slit_and_mapped(surface, bound, options, observer);
    let maps = |pieces: Vec<Piece>| {
        let maps = pieces.into_iter().filter_map(|piece| piece.map).collect();
        given_back(surface, maps, bound, options, observer)
    };
    if mean_excess(&slit) <= bound.budget() || observer.control() == Control::Finish {
        return maps(slit);
    }
    let divided = map_all(charts(surface, Cut::Fast), options, observer);
    let divided: Vec<Piece> = divided.into_iter().map(Piece::of).collect();
    let better = if mean_excess(&divided) < mean_excess(&slit) {
        divided
    } else {
        slit
    };
    maps(better)
}

fn map_all(
    charts: Vec<Chart>,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    (charts.into_par_iter().with_max_len(1))
        .flat_map_iter(|chart| map_chart(chart, options, Folds::Cut, observer))
        .collect()
}

/// Whether most of the area lies in triangles whose shape no map keeps: slits and divisions cannot lessen that.
fn is_mostly_needles(surface: &Surface) -> bool {
    let (mut area, mut of_needles) = (0.0, 0.0);
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|v| surface.positions[v as usize]);
        let doubled = norm(area_vector(a, b, c));
        area += doubled;
        of_needles += if is_needle([a, b, c]) { doubled } else { 0.0 };
    }
    of_needles > 0.5 * area
}

fn mean_excess(pieces: &[Piece]) -> f64 {
    let excess: f64 = pieces.iter().map(|piece| piece.excess).sum();
    excess / total_area(pieces)
}

fn total_area(pieces: &[Piece]) -> f64 {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    area.max(f64::MIN_POSITIVE)
}

/// Whether more of the area is stretched beyond the bound than may be.
fn is_stretched(pieces: &[Piece], bound: &Bound) -> bool {
    let Some(most) = bound.stretch else {
        return false;
    };
    let maps = pieces.iter().filter_map(|piece| piece.map.as_ref());
    let stretched: f64 = maps.map(|map| stretched_area(map, most)).sum();
    stretched > Bound::stretched_budget() * total_area(pieces)
}

fn slit_and_mapped(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<Piece> {
    let first = |chart: Chart| {
        if chart.disk.triangles.len() < LARGE {
            return vec![Piece::unmapped(chart)];
        }
        let parts = slit_as_simplified(chart, bound, options, observer).into_iter();
        let maps = parts.flat_map(|part| map_chart(part, options, Folds::Cut, observer));
        maps.map(Piece::of).collect()
    };
    let pieces = charts(surface, Cut::Auto);
    let pieces = pieces.into_par_iter().with_max_len(1).flat_map_iter(first);
    rounds(pieces.collect(), bound, options, observer, |_| ())
}

/// A chart with the slits that its simplification needs to keep the bound: large charts are mapped once or twice, not in every round.
fn slit_as_simplified(
    chart: Chart,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<Chart> {
    let Some(simple) = Simplified::new(&chart, SIMPLE) else {
        return vec![chart];
    };
    let mut tips = Vec::new();
    let pieces = vec![Piece::unmapped(simple.chart.clone())];
    rounds(pieces, bound, options, observer, |slits| {
        tips.extend(slits.tips().map(|corner| simple.vertex(corner)));
    });
    Slits::from_tips(chart, &tips).opened()
}

/// Slits and maps pieces in rounds until their maps keep the bound, or that is hopeless; `see` is shown what is slit.
fn rounds(
    mut pieces: Vec<Piece>,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
    mut see: impl FnMut(&Slits),
) -> Vec<Piece> {
    let n_faces: usize = pieces.iter().map(Piece::n_faces).sum();
    let budget = bound.budget();
    let mut wanted = budget;
    let mut before = f64::INFINITY;
    for round in 0..MOST_ROUNDS {
        slit(&mut pieces, wanted, observer);
        pieces.iter().filter_map(Piece::slits).for_each(&mut see);
        pieces = pieces
            .into_par_iter()
            .with_max_len(1)
            .flat_map_iter(|piece| piece.mapped(options, observer))
            .collect();
        let reached = mean_excess(&pieces);
        let is_hopeless = reached > HOPELESS[0] * before && reached > HOPELESS[1] * budget;
        if is_hopeless || observer.control() == Control::Finish {
            break;
        }
        wanted = if reached > budget {
            // Where maps keep falling short of what they promised, less is promised.
            let promised = budget * PROMISE.powi(round as i32);
            if n_faces <= PATIENT {
                (reached * promised).sqrt().min(2.0 * promised)
            } else {
                promised
            }
        } else if is_stretched(&pieces, bound) {
            TIGHTER * reached
        } else {
            break;
        };
        before = reached;
    }
    pieces
}

/// Slits where the excess that is to be expected is largest, until its mean is as wanted.
///
/// Ends early when the observer wants the work to end: then fewer slits have to do.
fn slit(pieces: &mut [Piece], wanted: f64, observer: &dyn Observer) {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let mut is_done = vec![false; pieces.len()];
    let mut expected: f64 = pieces.iter().map(|piece| piece.excess).sum();
    while expected > wanted * area && observer.control() == Control::Continue {
        let open = (0..pieces.len()).filter(|&i| !is_done[i]);
        let worst = open.max_by(|&i, &j| {
            let (a, b) = (pieces[i].excess, pieces[j].excess);
            a.total_cmp(&b).then(j.cmp(&i))
        });
        let Some(worst) = worst else {
            return;
        };
        expected -= pieces[worst].excess;
        // Far from the goal several slits at once do as well as one after the other.
        let is_far = expected > 2.0 * wanted * area;
        is_done[worst] = !pieces[worst].cut(is_far);
        observer.worked(pieces[worst].n_faces());
        expected += pieces[worst].excess;
    }
}
