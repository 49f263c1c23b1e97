//! Charts cut where that makes their atlas fuller.

use super::chart_maps::chart_maps;
use crate::atlas::{AtlasError, AtlasOptions, Draft, OnRead, Scale, Texture};
use crate::charts::{MappedChart, Split, seam_length};
use crate::solver::Control;
use rayon::prelude::*;
use std::sync::Arc;

/// The share of the square that seams must gain which are as long as those there are, or as a side of the surface's square if that is
/// longer.
const PRICE: f64 = 0.03;
/// A further chart costs as much as a seam of this length, in sides of the surface's square.
const PER_CHART: f64 = 0.4;
/// Cuts at most for each page, in all and for each chart that there was.
const MOST_CUTS: u64 = 18;
const MOST_CUTS_PER_CHART: u64 = 14;
/// Charts at most that are cut: of more the small ones fill what the large ones leave empty.
pub const MOST_CHARTS: usize = 64;
/// What cuts may cost at most, as a share of the square.
const MOST_COST: f64 = 1.0;
/// Words for packing without which one more cut is not looked at, which takes about as long as reading them.
const WORDS_PER_CUT: u64 = 4_000_000;

/// Charts and a draft of their layout.
pub struct Drafted {
    pub charts: Vec<MappedChart>,
    pub draft: Option<Draft>,
}

impl Drafted {
    pub fn new(charts: Vec<MappedChart>, options: &AtlasOptions) -> Result<Self, AtlasError> {
        let draft = Draft::new(&chart_maps(&charts), options)?;
        Ok(Self { charts, draft })
    }
}

/// The charts after as many cuts as pay: what they gain of the square is more than their length costs.
///
/// The cut is made first that is worth most by the hulls and sizes of its parts, which say well where to cut but not when to stop:
/// that a search for full layouts decides, in which the charts before and after each cut compete. Maps stay as they are.
/// `seam_price` multiplies the price of a seam: with 0 all cuts that gain anything are made. The
/// charts may become as many as `most_charts`.
pub fn compacted(
    charts: Vec<MappedChart>,
    options: &AtlasOptions,
    (seam_price, most_charts): (f64, Option<u32>),
    on_read: &OnRead,
) -> Result<Drafted, AtlasError> {
    let Drafted { charts, draft } = Drafted::new(charts, options)?;
    let draft = match draft {
        Some(draft) if charts.len() <= MOST_CHARTS => draft,
        draft => return Ok(Drafted { charts, draft }),
    };
    let words = options.search_words / 4 * 3;
    let (n_charts, pages) = (charts.len() as u64, u64::from(options.texture.pages));
    let wanted = most_charts.map_or(u64::MAX, u64::from);
    let most_cuts = (wanted.saturating_sub(n_charts))
        .min(MOST_CUTS * pages)
        .min(MOST_CUTS_PER_CHART * n_charts * pages)
        .min(words / WORDS_PER_CUT);
    let candidates = candidates(
        charts,
        draft,
        seam_price,
        most_cuts as usize,
        options,
        on_read,
    )?;
    let Candidate { charts, draft, .. } = fullest(candidates, words, on_read);
    Ok(Drafted {
        charts: charts.into_iter().map(Arc::unwrap_or_clone).collect(),
        draft: Some(draft),
    })
}

/// Charts after some cuts.
#[derive(Clone)]
struct Candidate {
    charts: Vec<Arc<MappedChart>>,
    draft: Draft,
    /// What the cuts cost, as a share of the square.
    cost: f64,
    /// The share of the square that they have to fill, where a scale is given.
    wanted: Option<f64>,
}

impl Candidate {
    /// The share of the square that is filled, less what the cuts cost. Where a scale is given what is filled beyond that is worth
    /// nothing, and charts that fill it are worth more than any that do not.
    fn value(&self) -> f64 {
        let fill = self.draft.fill();
        match self.wanted {
            None => fill - self.cost,
            Some(wanted) if fill < wanted => fill - wanted - MOST_COST,
            Some(_) => -self.cost,
        }
    }
}

/// The charts as they are, after the cut that is worth most, after another, and so on.
fn candidates(
    charts: Vec<MappedChart>,
    draft: Draft,
    seam_price: f64,
    most_cuts: usize,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Vec<Candidate>, AtlasError> {
    let area = charts.iter().map(MappedChart::area).sum::<f64>();
    let Texture { resolution, pages } = options.texture;
    let [shorter, longer] = [resolution.shorter(), resolution.longer()].map(f64::from);
    // A chart has to fit across a page that is not square, but may be longer than it is wide.
    let of_page = (area / f64::from(pages) * (shorter / longer).sqrt()).sqrt();
    let per_chart = PER_CHART * area.sqrt();
    let seams = seam_length(&charts).max(area.sqrt()).max(f64::MIN_POSITIVE);
    let price = PRICE * seam_price / seams;
    let mut candidate = Candidate {
        charts: charts.into_iter().map(Arc::new).collect(),
        draft,
        cost: 0.0,
        wanted: match options.scale {
            Scale::Largest => None,
            Scale::TexelsPerUnit(texels) => {
                Some(area * texels * texels / (shorter * longer * f64::from(pages)))
            }
        },
    };
    let mut splits = best_splits(&candidate.charts, of_page, on_read);
    let mut candidates = vec![candidate.clone()];
    while candidates.len() <= most_cuts
        && candidate.cost < MOST_COST
        && on_read(WORDS_PER_CUT) == Control::Continue
    {
        let Some((chart, split)) = most_worth(&splits) else {
            break;
        };
        let parts = candidate.charts[chart].parted(split);
        let Some(draft) = candidate.draft.replaced(chart, &chart_maps(&parts))? else {
            break;
        };
        candidate.draft = draft;
        candidate.cost += price * (split.length + per_chart);
        candidate.charts.remove(chart);
        splits.remove(chart);
        let parts: Vec<_> = parts.into_iter().map(Arc::new).collect();
        splits.extend(best_splits(&parts, of_page, on_read));
        candidate.charts.extend(parts);
        candidates.push(candidate.clone());
    }
    Ok(candidates)
}

/// The candidate of most value, and a full layout of it.
///
/// All are searched equally long, those that are worth more go on, half as many and each twice as long, until two are left.
/// From: Karnin, Koren, Somekh 2013, Almost Optimal Exploration in Multi-Armed Bandits (successive halving).
fn fullest(mut candidates: Vec<Candidate>, words: u64, on_read: &OnRead) -> Candidate {
    let rounds = u64::from(candidates.len().next_power_of_two().ilog2().max(1));
    for round in 0..rounds {
        let share = words / rounds / candidates.len() as u64;
        let each = candidates.par_iter_mut().with_max_len(1);
        each.for_each(|candidate| {
            candidate.draft.improve(share, round, on_read);
        });
        candidates.sort_by(|a, b| b.value().total_cmp(&a.value()));
        candidates.truncate(candidates.len().div_ceil(2));
    }
    candidates.swap_remove(0)
}

fn best_splits(charts: &[Arc<MappedChart>], unit: f64, on_read: &OnRead) -> Vec<Option<Split>> {
    let each = charts.par_iter().with_max_len(1);
    each.map(|chart| chart.best_split(unit, &|| on_read(0)))
        .collect()
}

/// The chart that a cut is worth most for, the first of equals, and the cut.
fn most_worth(splits: &[Option<Split>]) -> Option<(usize, &Split)> {
    let cuts = splits.iter().enumerate().rev();
    let cuts = cuts.filter_map(|(chart, split)| Some((chart, split.as_ref()?)));
    cuts.max_by(|a, b| a.1.worth.total_cmp(&b.1.worth))
}
