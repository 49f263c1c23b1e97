//! Charts cut where that makes their atlas fuller.

use super::arrays::chart_maps;
use super::settings::Settings;
use crate::atlas::{AtlasError, AtlasOptions, Draft};
use crate::charts::{MappedChart, Split};
use rayon::prelude::*;

/// The share of the square that a seam as long as the side of the surface's square must gain.
const PRICE: f64 = 0.025;
/// Cuts at most.
const MOST_CUTS: u64 = 20;
/// Cuts in a row that may leave the atlas no better than the best before.
const PATIENCE: usize = 9;
/// Charts at most that are cut: of more the small ones fill what the large ones leave empty.
const MOST_CHARTS: usize = 64;
/// What share of the words for packing the layout may read after each cut.
const WORDS_PER_CUT: u64 = 40;

/// Charts and a draft of their layout.
pub(super) struct Drafted {
    pub charts: Vec<MappedChart>,
    pub draft: Option<Draft>,
}

impl Drafted {
    pub(super) fn new(
        charts: Vec<MappedChart>,
        options: &AtlasOptions,
    ) -> Result<Self, AtlasError> {
        let draft = Draft::new(&chart_maps(&charts), options)?;
        Ok(Self { charts, draft })
    }
}

/// The charts after the cuts that pay: each gains more of the square than its length costs.
///
/// The cut is made first that is worth most by the hulls and sizes of its parts, which say well where to cut but not when to stop:
/// a coarse layout is improved a little after each, and the best one counts, since some cuts gain only together. Maps
/// stay as they are. `seam_weight` multiplies the price of a seam: with 0 all cuts that gain anything are made.
pub(super) fn compacted(
    charts: Vec<MappedChart>,
    options: &AtlasOptions,
    settings: &Settings,
) -> Result<Drafted, AtlasError> {
    let Drafted { charts, draft } = Drafted::new(charts, options)?;
    let draft = match draft {
        Some(draft) if charts.len() <= MOST_CHARTS => draft,
        draft => return Ok(Drafted { charts, draft }),
    };
    let most_charts = settings.max_charts.map_or(usize::MAX, |n| n as usize);
    let words = options.search_words / WORDS_PER_CUT;
    let unit = charts.iter().map(MappedChart::area).sum::<f64>().sqrt();
    let price = PRICE * settings.seam_weight / unit;
    let mut cut = Cuts::new(charts, draft, unit);
    cut.draft.improve(words, 0);
    let mut best = cut.clone();
    let mut worse = 0;
    for seed in 1..=MOST_CUTS {
        if cut.charts.len() >= most_charts || worse == PATIENCE || !cut.cut(unit)? {
            break;
        }
        cut.draft.improve(words, seed);
        // The best is searched on as long: else the last would be the fullest because it was searched for longest.
        best.draft.improve(words, seed);
        worse += 1;
        if cut.value(price) > best.value(price) {
            best = cut.clone();
            worse = 0;
        }
    }
    Ok(Drafted {
        charts: best.charts,
        draft: Some(best.draft),
    })
}

/// Charts after some cuts.
#[derive(Clone)]
struct Cuts {
    charts: Vec<MappedChart>,
    /// The best next cut of each.
    splits: Vec<Option<Split>>,
    draft: Draft,
    /// The length of the cuts.
    seam: f64,
}

impl Cuts {
    fn new(charts: Vec<MappedChart>, draft: Draft, unit: f64) -> Self {
        Self {
            splits: best_splits(&charts, unit),
            charts,
            draft,
            seam: 0.0,
        }
    }

    /// The share of the square that is filled, less what the seams cost.
    fn value(&self, price: f64) -> f64 {
        self.draft.fill() - price * self.seam
    }

    /// Makes the cut that is worth most; false if there is none, or no place for its parts.
    fn cut(&mut self, unit: f64) -> Result<bool, AtlasError> {
        let Some((chart, split)) = most_worth(&self.splits) else {
            return Ok(false);
        };
        let parts = self.charts[chart].parted(split);
        let Some(draft) = self.draft.replaced(chart, &chart_maps(&parts))? else {
            return Ok(false);
        };
        self.draft = draft;
        self.seam += split.length;
        self.splits.remove(chart);
        self.splits.extend(best_splits(&parts, unit));
        self.charts.remove(chart);
        self.charts.extend(parts);
        Ok(true)
    }
}

fn best_splits(charts: &[MappedChart], unit: f64) -> Vec<Option<Split>> {
    let each = charts.par_iter().with_max_len(1);
    each.map(|chart| chart.best_split(unit)).collect()
}

/// The chart that a cut is worth most for, the first of equals, and the cut.
fn most_worth(splits: &[Option<Split>]) -> Option<(usize, &Split)> {
    let cuts = splits.iter().enumerate().rev();
    let cuts = cuts.filter_map(|(chart, split)| Some((chart, split.as_ref()?)));
    cuts.max_by(|a, b| a.1.worth.total_cmp(&b.1.worth))
}
