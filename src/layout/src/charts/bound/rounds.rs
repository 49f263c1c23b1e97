//! Charts slit and mapped in rounds.

use super::distortion::stretched_area;
use super::pending_chart::PendingChart;
use super::quality::Bound;
use crate::charts::chart::Chart;
use crate::charts::observer::Observer;
use crate::charts::symmetry::counterpart::counterparts;
use rayon::prelude::*;
use unwrapd_maps::embed;
use unwrapd_method::solver::Control;

/// What each round promises of what the one before promised.
const PROMISE: f64 = 0.95;

/// Triangles up to which the next round goes half of the way to the bound: slits gain more than is expected of them, and of what is
/// too much nothing comes back. With more of them a round costs seconds.
const PATIENT: usize = 30_000;

/// The share of the mean excess that is aimed at where the stretch is too large.
const TIGHTER: f64 = 0.7;

/// Rounds of cutting and mapping at most. One to three are the rule.
const MOST_ROUNDS: usize = 8;

/// A round that leaves more than this share of the excess, and that many times more than there may be, shows that slits do
/// not help: a sponge of a thousand handles stays one.
const HOPELESS: [f64; 2] = [0.7, 4.0];

/// So many times more than there may be shows it in the first round.
const HOPELESS_AT_ONCE: f64 = 1_000.0;

/// Slits and maps pieces in rounds until their maps keep the bound, or that is hopeless.
pub fn rounds(
    mut pieces: Vec<PendingChart>,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<PendingChart> {
    let n_faces: usize = pieces.iter().map(PendingChart::n_faces).sum();
    let budget = bound.budget();
    let mut wanted = budget;
    let mut before = f64::INFINITY;
    observer.charted(0, pieces.len() as isize);
    for round in 0..MOST_ROUNDS {
        slit(&mut pieces, wanted, observer);
        let again = pieces.iter().filter(|piece| piece.is_mapped_again());
        observer.charted(-(again.count() as isize), 0);
        pieces = pieces
            .into_par_iter()
            .with_max_len(1)
            .flat_map_iter(|piece| piece.mapped(options, observer))
            .collect();
        let reached = mean_excess(&pieces);
        let is_hopeless = reached > HOPELESS_AT_ONCE * budget
            || reached > HOPELESS[0] * before && reached > HOPELESS[1] * budget;
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
fn slit(pieces: &mut [PendingChart], wanted: f64, observer: &dyn Observer) {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let mut is_done = vec![false; pieces.len()];
    let counterpart = counterparts_of(pieces);
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
        // Far from the goal several slits at once do as well as one after the other.
        let is_far = expected > 2.0 * wanted * area;
        expected -= pieces[worst].excess;
        let n_slits = pieces[worst].n_slits();
        is_done[worst] = !pieces[worst].cut(is_far);
        observer.worked(pieces[worst].n_faces());
        expected += pieces[worst].excess;
        if let Some(other) = counterpart[worst] {
            let images = pieces[worst].images(n_slits);
            expected -= pieces[other].excess;
            pieces[other].cut_along(&images);
            observer.worked(pieces[other].n_faces());
            expected += pieces[other].excess;
        }
    }
}

/// For each piece the other that is its mirror image.
fn counterparts_of(pieces: &[PendingChart]) -> Vec<Option<usize>> {
    let charts: Option<Vec<&Chart>> = pieces.iter().map(PendingChart::chart).collect();
    let charts = charts.filter(|charts| charts.iter().any(|chart| chart.mirror.is_some()));
    charts.map_or(vec![None; pieces.len()], |charts| counterparts(&charts))
}

/// The excess of all pieces over their area.
pub fn mean_excess(pieces: &[PendingChart]) -> f64 {
    let excess: f64 = pieces.iter().map(|piece| piece.excess).sum();
    excess / total_area(pieces)
}

fn total_area(pieces: &[PendingChart]) -> f64 {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    area.max(f64::MIN_POSITIVE)
}

/// Whether more of the area is stretched beyond the bound than may be.
fn is_stretched(pieces: &[PendingChart], bound: &Bound) -> bool {
    let Some(most) = bound.stretch else {
        return false;
    };
    let maps = pieces.iter().filter_map(|piece| piece.map.as_ref());
    let stretched: f64 = maps
        .map(|map| stretched_area(map, &map.rest_shapes(), most))
        .sum();
    stretched > Bound::stretched_budget() * total_area(pieces)
}
