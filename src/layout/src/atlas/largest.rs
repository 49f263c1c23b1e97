//! The largest scale at which charts find places around others that stay.
use super::attempt::{Attempt, Packing};
use super::plan::{HOPE, QuarterTurns};
use super::stays::Staying;
use super::{AtlasOptions, Rotation, Scale};
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

/// Scales tried after the first at which the charts fit.
const ATTEMPTS: usize = 12;
/// The search ends when the largest scale and one that failed are as near as this.
const NEAR: f64 = 1.003;
/// By how much the scale grows as long as the charts fit.
const LARGER: f64 = 1.15;
/// By how much the scale shrinks where they do not, at most and at least.
const SMALLER: [f64; 2] = [0.5, 0.95];
/// The share of what area allows from which on a scale is too small to be of use: there is no room.
const LEAST: f64 = 0.01;
/// The share of the pages that is hoped to be free at least.
const LEAST_FREE: f64 = 1e-3;
/// By how much the scale grows with each order that allows it, and how many in vain end the search.
const GROWTH: f64 = 1.004;
const MOST_IDLE: u64 = 100;
const SEED: u64 = 1;

/// The scale, in cells per mesh unit, and a place for every chart; none where one finds none.
pub(super) fn placed(
    packing: &Packing,
    staying: &[Staying],
    options: &AtlasOptions,
) -> Option<(f64, Attempt)> {
    let cells = f64::from(packing.cells);
    if packing.plan.order.is_empty() {
        // The unit of what stays is that of a page.
        return Some((cells, packing.attempt(cells, &mut 0).ok()?));
    }
    match options.scale {
        Scale::Largest => {
            let found = largest(packing, staying, options.search_words)?;
            Some(grown(packing, found, options))
        }
        Scale::TexelsPerUnit(texels) => {
            let scale = texels * cells / f64::from(options.texture.resolution.longer());
            Some((scale, packing.attempt(scale, &mut 0).ok()?))
        }
    }
}

/// The same at the largest scale that is found.
fn largest(packing: &Packing, staying: &[Staying], search_words: u64) -> Option<(f64, Attempt)> {
    let texture = packing.texture;
    let pages = f64::from(texture.pages) * texture.share();
    let taken: f64 = staying.iter().map(|chart| chart.outline.size.powi(2)).sum();
    let free = (pages - taken).max(LEAST_FREE * pages) * f64::from(packing.cells).powi(2);
    let most = (free / packing.plan.area()).sqrt();
    // Charts without area: at this scale the longest is as long as a page.
    let most = if most.is_finite() {
        most
    } else {
        f64::from(packing.cells) / packing.plan.longest().max(1.0 / f64::from(packing.cells))
    };
    let mut scale = HOPE.sqrt() * most;
    let mut best: Option<(f64, Attempt)> = None;
    let (mut failed, mut work, mut tried) = (f64::INFINITY, 0, 0);
    while scale >= LEAST * most {
        match packing.attempt(scale, &mut work) {
            Ok(attempt) => best = Some((scale, attempt)),
            Err(share) => {
                failed = scale;
                scale *= share.sqrt().clamp(SMALLER[0], SMALLER[1]);
            }
        }
        if let Some((good, _)) = best {
            let is_ended = (packing.on_read)(0) == Control::Finish || work > search_words;
            if is_ended || tried == ATTEMPTS || failed < good * NEAR {
                break;
            }
            tried += 1;
            scale = if failed.is_finite() {
                (good * failed).sqrt()
            } else {
                LARGER * good
            };
        }
    }
    best
}

/// The same at a larger scale, if another order or other quarter turns are found by chance that allow it; a crowd hardly gains by
/// that.
fn grown(
    packing: &Packing,
    (mut scale, mut best): (f64, Attempt),
    options: &AtlasOptions,
) -> (f64, Attempt) {
    let n = packing.plan.order.len();
    let mut plan = packing.plan.clone();
    let mut random = Random::new(SEED);
    let (mut work, mut idle) = (0, 0);
    let most_idle = MOST_IDLE * options.patience;
    while n > 1 && !packing.is_crowded() && idle < most_idle && work < options.search_words {
        if (packing.on_read)(0) == Control::Finish {
            break;
        }
        let mut trial = plan.clone();
        let [i, j] = [random.below(n), random.below(n)];
        match random.below(3) {
            0 => trial.order.swap(i, j),
            1 => {
                let chart = trial.order.remove(i);
                trial.order.insert(j, chart);
            }
            _ => {
                let turns = match options.rotation {
                    Rotation::Any | Rotation::Quarter => random.below(4) as u32,
                    Rotation::None => 0,
                };
                trial.turns[trial.order[i]] = QuarterTurns::Only(turns);
            }
        }
        let tried = Packing {
            plan: &trial,
            ..*packing
        };
        match tried.attempt(GROWTH * scale, &mut work) {
            Ok(attempt) => {
                (scale, best, plan, idle) = (GROWTH * scale, attempt, trial, 0);
            }
            Err(_) => idle += 1,
        }
    }
    (scale, best)
}
