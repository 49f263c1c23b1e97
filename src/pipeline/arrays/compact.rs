//! Charts cut where that makes their atlas fuller.

use super::candidate::{Candidate, MOST_COST, Search, wanted_words};
use super::chart_maps::chart_maps;
use crate::atlas::{AtlasError, AtlasOptions, Draft, OnRead, Scale, Texture};
use crate::charts::{MappedChart, Split, parted_alike, seam_length};
use crate::solver::Control;
use rayon::prelude::*;
use std::sync::Arc;

/// The share of a page that new seams must gain if they are as long as those there are. Where those are shorter than the square
/// root of the surface's area, that counts as their length.
const PRICE: f64 = 0.04;
/// A further chart costs as much as a seam of this length, in sides of the surface's square.
const PER_CHART: f64 = 0.4;
/// Candidates at most for each page beside the charts as they are, in all and for each chart that there was.
const MOST_CANDIDATES: usize = 18;
const MOST_CANDIDATES_PER_CHART: usize = 14;
/// Candidates differ by one cut, and one more for so many charts beyond so many: of those one cut changes little.
const CHARTS_PER_CUT: usize = 16;
const CHARTS_OF_ONE_CUT: usize = 64;
/// Charts at most that are cut, several small ones counted as one.
pub const MOST_CHARTS: usize = 512;
/// The words that looking for one more cut counts for.
const WORDS_PER_CUT: u64 = 1_000_000;
/// Cuts that are made before any of them is looked at, and how often in a row, for each page, none of them may be better.
const BATCH: usize = 4;
const MOST_IDLE: usize = 2;

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
        Some(draft) if draft.n_charts() <= MOST_CHARTS => draft,
        draft => return Ok(Drafted { charts, draft }),
    };
    let wanted = most_charts.map_or(usize::MAX, |most| most as usize);
    let most = most_candidates(charts.len(), options).min(wanted.saturating_sub(charts.len()));
    let search = Search::new(charts.len(), most, options, on_read);
    let cutter = Cutter::new(charts, draft, (seam_price, wanted), &search);
    let candidates = candidates(cutter, most)?;
    let Candidate { charts, draft, .. } = search.fullest(candidates);
    Ok(Drafted {
        charts: charts.into_iter().map(Arc::unwrap_or_clone).collect(),
        draft: Some(draft),
    })
}

/// Candidates of so many charts at most, beside the charts as they are.
fn most_candidates(n_charts: usize, options: &AtlasOptions) -> usize {
    options.texture.pages as usize * MOST_CANDIDATES.min(MOST_CANDIDATES_PER_CHART * n_charts)
}

/// The words that are read where so many charts are cut and half of the cuts are looked at, about.
pub fn expected_words(n_charts: usize, options: &AtlasOptions) -> u64 {
    let candidates = most_candidates(n_charts, options) / 2;
    let numbers: Vec<usize> = (n_charts..=n_charts + candidates).collect();
    let words = options.patience * wanted_words(&numbers);
    WORDS_PER_CUT * candidates as u64 + words.min(options.search_words)
}

/// The charts as they are, after the cut that is worth most, after another, and so on, all looked at once; of many charts, after
/// several cuts each. The end is where many in a row bring nothing; of a crowd, whose value is a matter of luck, where there are enough.
fn candidates(mut cutter: Cutter, most: usize) -> Result<Vec<Candidate>, AtlasError> {
    let search = cutter.search;
    let mut candidates = vec![cutter.candidate.clone()];
    let mut best = search.most_valued(&mut candidates);
    let mut idle = 0;
    let most_idle = MOST_IDLE * search.options.texture.pages as usize;
    while idle < most_idle || cutter.candidate.draft.is_crowded() {
        let mut batch = Vec::new();
        while batch.len() < BATCH
            && candidates.len() + batch.len() <= most
            && let Some(cut) = cutter.next()?
        {
            batch.push(cut);
        }
        if batch.is_empty() {
            break;
        }
        let value = search.most_valued(&mut batch);
        candidates.extend(batch);
        idle = if value > best { 0 } else { idle + 1 };
        best = best.max(value);
    }
    Ok(candidates)
}

/// Cuts charts one by one.
struct Cutter<'a> {
    search: &'a Search<'a>,
    candidate: Candidate,
    /// For each chart the cut that is worth most.
    splits: Vec<Option<Split>>,
    /// The square root of a page's area.
    of_page: f64,
    /// What a length of seam costs, as a share of the square, and what a chart costs as a length.
    price: f64,
    per_chart: f64,
    most_charts: usize,
}

impl<'a> Cutter<'a> {
    fn new(
        charts: Vec<MappedChart>,
        draft: Draft,
        (seam_price, most_charts): (f64, usize),
        search: &'a Search<'a>,
    ) -> Self {
        let options = search.options;
        let area = charts.iter().map(MappedChart::area).sum::<f64>();
        let Texture { resolution, pages } = options.texture;
        let [shorter, longer] = [resolution.shorter(), resolution.longer()].map(f64::from);
        let seams = seam_length(&charts).max(area.sqrt()).max(f64::MIN_POSITIVE);
        // A chart has to fit across a page that is not square, but may be longer than it is wide.
        let of_page = (area / f64::from(pages) * (shorter / longer).sqrt()).sqrt();
        let charts: Vec<_> = charts.into_iter().map(Arc::new).collect();
        Self {
            search,
            splits: best_splits(&charts, of_page, search.on_read),
            candidate: Candidate {
                charts,
                draft,
                cost: 0.0,
                wanted: match options.scale {
                    Scale::Largest => None,
                    Scale::TexelsPerUnit(texels) => {
                        Some(area * texels * texels / (shorter * longer * f64::from(pages)))
                    }
                },
            },
            of_page,
            price: PRICE * seam_price / f64::from(pages) / seams,
            per_chart: PER_CHART * area.sqrt(),
            most_charts,
        }
    }

    /// The charts after some more cuts, those that are worth most; none where no chart can be cut, or none is worth it.
    fn next(&mut self) -> Result<Option<Candidate>, AtlasError> {
        let n_charts = self.candidate.draft.n_charts();
        let n_cuts = 1 + n_charts.saturating_sub(CHARTS_OF_ONE_CUT) / CHARTS_PER_CUT;
        for i in 0..n_cuts {
            if !self.cut()? {
                return Ok((i > 0).then(|| self.candidate.clone()));
            }
        }
        Ok(Some(self.candidate.clone()))
    }

    /// Makes the cut that is worth most; false where there is none.
    fn cut(&mut self) -> Result<bool, AtlasError> {
        let on_read = self.search.on_read;
        let candidate = &mut self.candidate;
        if candidate.cost >= MOST_COST || on_read(WORDS_PER_CUT) == Control::Finish {
            return Ok(false);
        }
        let Some((chart, split)) = most_worth(&self.splits) else {
            return Ok(false);
        };
        let parted = parted_alike(&candidate.charts, chart, split);
        let cost = self.price * (split.length + split.n_new() as f64 * self.per_chart);
        let cut = candidate.cut(parted, cost)?;
        let Some(cut) = cut.filter(|cut| cut.candidate.charts.len() <= self.most_charts) else {
            return Ok(false);
        };
        for &place in &cut.replaced {
            self.splits.remove(place);
        }
        *candidate = cut.candidate;
        let new = &candidate.charts[self.splits.len()..];
        (self.splits).extend(best_splits(new, self.of_page, on_read));
        Ok(true)
    }
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
