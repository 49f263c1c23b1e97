//! Charts cut where that makes their atlas fuller.

use super::candidate::{Candidate, ROUNDS, ROUNDS_FURTHER, Search, wanted_words};
use super::chart_maps::chart_maps;
use super::cutter::{Cutter, WORDS_PER_CUT};
use super::objective::{Objective, Pages};
use std::sync::Arc;
use unwrapd_layout::atlas::{
    AtlasError, AtlasOptions, CoarseLayout, Effort, OnRead, Scale, Texture,
};
use unwrapd_layout::charts::MappedChart;

/// Maximum number of candidates besides the uncut charts, per page: in all, and per original chart. For charts that
/// were cut for one page less before, `MOST_CANDIDATES` is the maximum over all pages.
const MOST_CANDIDATES: usize = 18;
const MOST_CANDIDATES_PER_CHART: usize = 14;
/// Maximum number of charts to cut, several small ones counted as one.
pub const MOST_CHARTS: usize = 512;
/// Cuts between two evaluations of the candidates, and number of such batches in a row, per page, that may bring nothing
/// better.
const BATCH: usize = 4;
const MOST_IDLE: usize = 2;

/// Number of further cuts without an expected improvement after which the search for cuts ends.
const MOST_LATER: usize = 8;

/// Number of charts up to which the fill depends on how they fit each other, which a search finds soon and a sum does
/// not show.
const FEW: usize = 6;

/// Advantage that one number of cuts needs over another, as a share of the square. Expected and found values differ
/// by this much even where only rounding differs.
const LEEWAY: f64 = 0.005;

/// Number of pages for which charts were cut before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Before {
    Nothing,
    /// Fewer pages, on which they reached this scale; 0 if they do not fit there at the given scale.
    FewerPages(f64),
}

/// Price and limit of the cuts that make an atlas fuller.
#[derive(Clone, Copy, Debug)]
pub struct CutTerms {
    /// Multiplies the cost of seams: 0 makes all cuts that gain anything.
    pub seam_weight: f64,
    /// Components of the surface, whose charts cost nothing.
    pub n_components: usize,
    /// Maximum number of charts.
    pub most_charts: Option<u32>,
}

/// Charts and a coarse layout of them.
pub struct CoarseAtlas {
    pub charts: Vec<MappedChart>,
    pub layout: Option<CoarseLayout>,
}

impl CoarseAtlas {
    pub fn new(charts: Vec<MappedChart>, options: &AtlasOptions) -> Result<Self, AtlasError> {
        let layout = CoarseLayout::new(&chart_maps(&charts), options)?;
        Ok(Self { charts, layout })
    }
}

/// Cuts charts as long as it pays: as long as a cut gains more of the page than the [objective](Objective) asks for its seam.
///
/// Makes the most valuable cut first, by the hulls and sizes of its parts. These estimates tell well where to cut,
/// but only roughly when to stop. A search for full layouts decides that: the expected number of cuts competes with
/// one cut less and one more; where the fill cannot be foreseen from the charts, all numbers compete. Maps stay as
/// they are.
///
/// `terms` says what cuts cost. Returns `None` if no number of cuts can exceed the scale that was reached on fewer pages.
pub fn compacted(
    (charts, before): (Vec<MappedChart>, Before),
    options: &AtlasOptions,
    terms: CutTerms,
    on_read: &OnRead,
) -> Result<Option<CoarseAtlas>, AtlasError> {
    let CoarseAtlas { charts, layout } = CoarseAtlas::new(charts, options)?;
    let layout = match layout {
        Some(layout) if layout.n_charts() <= MOST_CHARTS => layout,
        layout => return Ok(Some(CoarseAtlas { charts, layout })),
    };
    let wanted = terms.most_charts.map_or(usize::MAX, |most| most as usize);
    let most =
        most_candidates(charts.len(), options, before).min(wanted.saturating_sub(charts.len()));
    let is_foreseeable = is_foreseeable(options) && !layout.is_crowded();
    let search = Search::new(
        (charts.len(), most),
        rounds(is_foreseeable, before),
        options,
        on_read,
    );
    let CutTerms {
        seam_weight,
        n_components,
        ..
    } = terms;
    let pages = Pages::of(options);
    let objective = Objective::new(&charts, n_components, seam_weight, pages);
    let elsewhere = elsewhere(&charts, &layout, pages, options)?;
    let cutter = Cutter::new(charts, (layout, elsewhere), objective, wanted, &search);
    let candidates = if is_foreseeable {
        expected(cutter, most)?
    } else {
        candidates(cutter, most)?
    };
    let fullest = search.fullest(candidates);
    Ok(fullest.map(|Candidate { charts, layout, .. }| CoarseAtlas {
        charts: charts.into_iter().map(Arc::unwrap_or_clone).collect(),
        layout: Some(layout),
    }))
}

/// Returns coarse layouts on longer pages, if a chart is so long that it alone keeps the page from being filled.
fn elsewhere(
    charts: &[MappedChart],
    layout: &CoarseLayout,
    pages: Pages,
    options: &AtlasOptions,
) -> Result<Vec<CoarseLayout>, AtlasError> {
    let area: f64 = charts.iter().map(MappedChart::area).sum();
    if area * layout.most_scale().powi(2) >= 1.0 {
        return Ok(Vec::new());
    }
    let maps = chart_maps(charts);
    let layouts = pages.longer(options).into_iter();
    let layouts = layouts.map(|options| CoarseLayout::new(&maps, &options));
    Ok(layouts
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .flatten()
        .collect())
}

/// Returns whether the fill can be foreseen from the charts, unless they are a crowd: on one square page, without a
/// given scale.
fn is_foreseeable(options: &AtlasOptions) -> bool {
    let Texture { resolution, pages } = options.texture;
    let is_square = resolution.shorter() == resolution.longer();
    pages == 1 && is_square && options.scale == Scale::Largest
}

/// Returns the rounds of the search, and the scale that they must exceed.
fn rounds(is_foreseeable: bool, before: Before) -> (&'static [(Effort, usize)], f64) {
    match before {
        Before::Nothing => (&ROUNDS[usize::from(is_foreseeable)..], 0.0),
        Before::FewerPages(reached) => (&ROUNDS_FURTHER, reached),
    }
}

/// Returns the maximum number of candidates for `n_charts` charts, besides the uncut charts.
fn most_candidates(n_charts: usize, options: &AtlasOptions, before: Before) -> usize {
    let pages = options.texture.pages as usize;
    match before {
        Before::Nothing => pages * MOST_CANDIDATES.min(MOST_CANDIDATES_PER_CHART * n_charts),
        Before::FewerPages(_) => MOST_CANDIDATES,
    }
}

/// Returns the approximate number of words that are read if `n_charts` charts are cut for one page and a quarter of
/// the cuts are made.
pub fn expected_words(n_charts: usize, options: &AtlasOptions) -> u64 {
    let candidates = MOST_CANDIDATES.min(MOST_CANDIDATES_PER_CHART * n_charts) / 4;
    let numbers: Vec<usize> = (n_charts..=n_charts + candidates).collect();
    let (rounds, _) = rounds(is_foreseeable(options), Before::Nothing);
    let words = options.patience * wanted_words(&numbers, rounds);
    WORDS_PER_CUT * candidates as u64 + words.min(options.budget_words)
}

/// Returns the uncut charts, the charts after the most valuable cut, after another, and so on, each with a low effort;
/// if there are many charts, after several cuts each. Ends after several batches in a row without gain; for a crowd,
/// whose value is a matter of luck, at the maximum number of candidates.
fn candidates(mut cutter: Cutter, most: usize) -> Result<Vec<Candidate>, AtlasError> {
    let search = cutter.search;
    let mut candidates = vec![cutter.candidate.clone()];
    let mut best = search.most_valued(&mut candidates);
    let (mut tried, mut idle) = (1, 0);
    let most_idle = MOST_IDLE * search.options.texture.pages as usize;
    while idle < most_idle || cutter.candidate.layout.is_crowded() {
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

/// Returns the charts after the fewest cuts whose expected value is the largest, within [`LEEWAY`], and after one cut
/// less and one more, which must be better by that. If the former are at most [`FEW`] charts, all smaller numbers of
/// cuts compete, too, after a low effort for each.
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
    if candidates[best].layout.n_charts() <= FEW {
        search.most_valued(&mut candidates);
        return Ok(candidates);
    }
    Ok(candidates.split_off(best.saturating_sub(1)))
}
