//! Charts cut where that makes their atlas fuller.

use super::candidate::{Candidate, LOOKS, LOOKS_FURTHER, Search, wanted_words};
use super::chart_maps::chart_maps;
use super::cutter::{Cutter, WORDS_PER_CUT};
use std::sync::Arc;
use unwrapd_layout::atlas::{AtlasError, AtlasOptions, Draft, Look, OnRead, Scale, Texture};
use unwrapd_layout::charts::MappedChart;

/// Candidates at most for each page beside the charts as they are, in all and for each chart that there was. There are as many in
/// all where the charts were cut for one page less before.
const MOST_CANDIDATES: usize = 18;
const MOST_CANDIDATES_PER_CHART: usize = 14;
/// Charts at most that are cut, several small ones counted as one.
pub const MOST_CHARTS: usize = 512;
/// Cuts that are made before any of them is looked at, and how often in a row, for each page, none of them may be better.
const BATCH: usize = 4;
const MOST_IDLE: usize = 2;

/// So many cuts further nothing better must be expected before the search for more cuts ends.
const MOST_LATER: usize = 8;

/// So many charts are few: what they fill is a matter of how they fit each other, which a search finds soon and no sum tells.
const FEW: usize = 6;

/// What a number of cuts has to be worth more, as a share of the square, to be better than another: what is expected and what a
/// search finds differ by as much where nothing but rounding does.
const LEEWAY: f64 = 0.005;

/// What charts were cut for before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Before {
    Nothing,
    /// Fewer pages, on which they reached this scale; 0 where they do not fit there at one that is given.
    FewerPages(f64),
}

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
/// The cut that is worth most by the hulls and sizes of its parts is made first. These say well where to cut, but only roughly when to
/// stop. That a search for full layouts decides: one cut less, one more and the expected number compete; where the fill cannot
/// be told from the charts, all numbers do. Maps stay as they are.
/// `seam_price` multiplies the price of a seam: with 0 all cuts that gain anything are made. The
/// charts may become as many as `most_charts`. None where no number of cuts leads beyond the scale that was reached on fewer pages.
pub fn compacted(
    (charts, before): (Vec<MappedChart>, Before),
    options: &AtlasOptions,
    (seam_price, most_charts): (f64, Option<u32>),
    on_read: &OnRead,
) -> Result<Option<Drafted>, AtlasError> {
    let Drafted { charts, draft } = Drafted::new(charts, options)?;
    let draft = match draft {
        Some(draft) if draft.n_charts() <= MOST_CHARTS => draft,
        draft => return Ok(Some(Drafted { charts, draft })),
    };
    let wanted = most_charts.map_or(usize::MAX, |most| most as usize);
    let most =
        most_candidates(charts.len(), options, before).min(wanted.saturating_sub(charts.len()));
    let is_foreseeable = is_foreseeable(options) && !draft.is_crowded();
    let search = Search::new(
        (charts.len(), most),
        looks(is_foreseeable, before),
        options,
        on_read,
    );
    let cutter = Cutter::new(charts, draft, (seam_price, wanted), &search);
    let candidates = if is_foreseeable {
        expected(cutter, most)?
    } else {
        candidates(cutter, most)?
    };
    let fullest = search.fullest(candidates);
    Ok(fullest.map(|Candidate { charts, draft, .. }| Drafted {
        charts: charts.into_iter().map(Arc::unwrap_or_clone).collect(),
        draft: Some(draft),
    }))
}

/// Whether the fill can be told from the charts, unless they are a crowd: on one square page, at no given scale.
fn is_foreseeable(options: &AtlasOptions) -> bool {
    let Texture { resolution, pages } = options.texture;
    let is_square = resolution.shorter() == resolution.longer();
    pages == 1 && is_square && options.scale == Scale::Largest
}

/// The looks that candidates get, and the scale that they have to exceed.
fn looks(is_foreseeable: bool, before: Before) -> (&'static [(Look, usize)], f64) {
    match before {
        Before::Nothing => (&LOOKS[usize::from(is_foreseeable)..], 0.0),
        Before::FewerPages(reached) => (&LOOKS_FURTHER, reached),
    }
}

/// Candidates of so many charts at most, beside the charts as they are.
fn most_candidates(n_charts: usize, options: &AtlasOptions, before: Before) -> usize {
    let pages = options.texture.pages as usize;
    match before {
        Before::Nothing => pages * MOST_CANDIDATES.min(MOST_CANDIDATES_PER_CHART * n_charts),
        Before::FewerPages(_) => MOST_CANDIDATES,
    }
}

/// The words that are read where so many charts are cut for one page and a quarter of the cuts are made, about.
pub fn expected_words(n_charts: usize, options: &AtlasOptions) -> u64 {
    let candidates = MOST_CANDIDATES.min(MOST_CANDIDATES_PER_CHART * n_charts) / 4;
    let numbers: Vec<usize> = (n_charts..=n_charts + candidates).collect();
    let (looks, _) = looks(is_foreseeable(options), Before::Nothing);
    let words = options.patience * wanted_words(&numbers, looks);
    WORDS_PER_CUT * candidates as u64 + words.min(options.search_words)
}

/// The charts as they are, after the cut that is worth most, after another, and so on, all looked at once; of many charts, after
/// several cuts each. The end is where many in a row bring nothing; of a crowd, whose value is a matter of luck, where there are enough.
fn candidates(mut cutter: Cutter, most: usize) -> Result<Vec<Candidate>, AtlasError> {
    let search = cutter.search;
    let mut candidates = vec![cutter.candidate.clone()];
    let mut best = search.most_valued(&mut candidates);
    let (mut tried, mut idle) = (1, 0);
    let most_idle = MOST_IDLE * search.options.texture.pages as usize;
    while idle < most_idle || cutter.candidate.draft.is_crowded() {
        let mut batch = Vec::new();
        while batch.len() < BATCH
            && tried <= most
            && let Some(cut) = cutter.next()?
        {
            tried += 1;
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

/// The charts after the fewest cuts that are expected to be worth most, within [`LEEWAY`], and after one cut less and one more, which
/// have to be better by that. Where these are [`FEW`] charts all smaller numbers of cuts compete, too, after a look at each.
///
/// The expected fill follows from the shapes of the charts alone, while what a short search finds is partly luck: charts of the same
/// shapes get the same cuts.
fn expected(mut cutter: Cutter, most: usize) -> Result<Vec<Candidate>, AtlasError> {
    let search = cutter.search;
    let mut candidates = vec![cutter.candidate.clone()];
    let mut values = vec![cutter.expected_value()];
    let mut best = 0;
    while candidates.len() <= most.min(best + MOST_LATER)
        && let Some(cut) = cutter.next()?
    {
        values.push(cutter.expected_value());
        candidates.push(cut);
        if values[values.len() - 1] > values[best] {
            best = values.len() - 1;
        }
    }
    let is_enough = |value: &f64| *value >= values[best] - LEEWAY;
    let best = values.iter().position(is_enough).unwrap_or(best);
    for (_, other) in (0..).zip(&mut candidates).filter(|(n, _)| *n != best) {
        other.cost += LEEWAY;
    }
    candidates.truncate(best + 2);
    if candidates[best].draft.n_charts() <= FEW {
        search.most_valued(&mut candidates);
        return Ok(candidates);
    }
    Ok(candidates.split_off(best.saturating_sub(1)))
}
