//! Few charts under a bound on their distortion.

use super::chart::{Cut, charts};
use super::distortion::{excess_and_area, stretched_area};
use super::give_back::given_back;
use super::mapped::{Folds, MappedChart, Observer, map_chart};
use super::quality::Bound;
use super::slits::Slits;
use crate::embed;
use crate::mesh::Surface;
use crate::solver::Control;
use rayon::prelude::*;

/// Mapped excess over predicted, before a chart has been mapped: a map trades angles for areas and does better than the
/// conformal flattening it is predicted by. Measured on 14 meshes: 0.1 to 0.3.
const MAPPED_OVER_PREDICTED: f64 = 0.17;

/// What each round promises of what the one before promised.
const PROMISE: f64 = 0.95;

/// Triangles up to which the next round goes half of the way to the bound: slits gain more than is expected of them, and of what is
/// too much nothing comes back. With more of them a round costs seconds.
const PATIENT: usize = 30_000;

/// The share of the mean excess that is aimed at where the stretch is too large.
const TIGHTER: f64 = 0.7;

/// The least and most that [`MAPPED_OVER_PREDICTED`] may become where a map says otherwise. One that got stuck far from its optimum
/// would ask for dozens of slits; the next round shows what is really missing.
const LEAST_AND_MOST_RATIO: [f64; 2] = [0.05, 0.5];

/// Rounds of cutting and mapping at most. One to three are the rule.
const MOST_ROUNDS: usize = 8;

/// A round that leaves more than this share of the excess, and that many times more than there may be, shows that slits do
/// not help: a sponge of a thousand handles stays one.
const HOPELESS: [f64; 2] = [0.7, 4.0];

/// The charts of a surface, mapped, whose mean symmetric Dirichlet energy keeps the bound where that can be had.
///
/// Each component is opened to a disk; disks are slit where the predictor says that they would be distorted most, until the sum
/// promises to keep the bound; then they are mapped, parted where a map overlaps itself, and slit further where the maps were
/// worse than promised. The bound is one for all charts: a slit is spent where the excess is largest. Where the stretch is too
/// large the same goes on as for a smaller mean. A surface on which this does not lead below the bound is divided as by
/// [`Cut::Fast`] if that does better. At last small charts are [given back](given_back).
pub fn charts_under_bound(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    let slit = slit_and_mapped(surface, bound, options, observer);
    let maps = |pieces: Vec<Piece>| {
        let maps = pieces.into_iter().filter_map(|piece| piece.map).collect();
        given_back(surface, maps, bound, options, observer)
    };
    if mean_excess(&slit) <= bound.budget() || observer.control() == Control::Finish {
        return maps(slit);
    }
    let divided: Vec<Piece> = charts(surface, Cut::Fast)
        .into_par_iter()
        .with_max_len(1)
        .flat_map_iter(|chart| map_chart(chart, options, Folds::Cut, observer))
        .map(|map| Piece::of(map, MAPPED_OVER_PREDICTED))
        .collect();
    let better = if mean_excess(&divided) < mean_excess(&slit) {
        divided
    } else {
        slit
    };
    maps(better)
}

/// A chart on its way below the bound.
struct Piece {
    slits: Option<Slits>,
    map: Option<MappedChart>,
    /// What the map costs, or is expected to cost with the slits that are planned; and the area it is spent on.
    excess: f64,
    area: f64,
    /// Mapped excess over predicted, as last seen here.
    ratio: f64,
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
    let mut pieces: Vec<Piece> = charts(surface, Cut::Auto)
        .into_par_iter()
        .map(|chart| Piece::unmapped(Slits::new(chart)))
        .collect();
    let budget = bound.budget();
    let mut wanted = budget;
    let mut before = f64::INFINITY;
    for round in 0..MOST_ROUNDS {
        slit(&mut pieces, wanted, observer);
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
            if surface.triangles.len() <= PATIENT {
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
        expected += pieces[worst].excess;
    }
}

impl Piece {
    fn unmapped(slits: Slits) -> Self {
        Self {
            excess: MAPPED_OVER_PREDICTED * slits.excess,
            area: slits.area,
            slits: Some(slits),
            map: None,
            ratio: MAPPED_OVER_PREDICTED,
        }
    }

    fn of(map: MappedChart, ratio: f64) -> Self {
        let [excess, area] = excess_and_area(&map);
        Self {
            slits: None,
            map: Some(map),
            excess,
            area,
            ratio,
        }
    }

    /// Plans a slit, or several; false if there is nothing to slit.
    fn cut(&mut self, is_far: bool) -> bool {
        let slits = match (&mut self.slits, &self.map) {
            (Some(slits), _) => slits,
            (none, Some(map)) => {
                let slits = Slits::new(map.chart.clone());
                let [least, most] = LEAST_AND_MOST_RATIO;
                let measured = self.excess / slits.excess.max(f64::MIN_POSITIVE);
                self.ratio = measured.clamp(least, most);
                none.insert(slits)
            }
            (None, None) => return false,
        };
        let is_cut = slits.cut(is_far);
        if is_cut {
            self.excess = self.ratio * slits.excess;
        }
        is_cut
    }

    /// Mapped, unless it is and no slit is new.
    fn mapped(self, options: &embed::Options, observer: &dyn Observer) -> Vec<Self> {
        match self.slits {
            Some(slits) if self.map.is_none() || slits.is_cut() => slits
                .opened()
                .into_iter()
                .flat_map(|chart| map_chart(chart, options, Folds::Cut, observer))
                .map(|map| Self::of(map, self.ratio))
                .collect(),
            _ => vec![Self {
                slits: None,
                ..self
            }],
        }
    }
}
