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
#[derive(Clone)]
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
    let Drafted { mut charts, draft } = Drafted::new(charts, options)?;
    let Some(mut draft) = draft.filter(|_| charts.len() <= MOST_CHARTS) else {
        return Drafted::new(charts, options);
    };
    let words = options.search_words / WORDS_PER_CUT;
    draft.improve(words, 0);
    let unit = charts.iter().map(MappedChart::area).sum::<f64>().sqrt();
    let split = |charts: &[MappedChart]| -> Vec<Option<Split>> {
        let each = charts.par_iter().with_max_len(1);
        each.map(|chart| chart.best_split(unit)).collect()
    };
    let mut splits = split(&charts);
    let mut best = (draft.fill(), charts.clone(), draft.clone());
    let (mut seam, mut worse) = (0.0, 0);
    let most_charts = settings.max_charts.map_or(usize::MAX, |n| n as usize);
    for seed in 1..=MOST_CUTS {
        if charts.len() >= most_charts {
            break;
        }
        let Some((cut, worst)) = most_worth(&splits) else {
            break;
        };
        seam += worst.length / unit;
        let parts = charts[cut].parted(worst);
        let Some(replaced) = draft.replaced(cut, &chart_maps(&parts))? else {
            break;
        };
        draft = replaced;
        draft.improve(words, seed);
        splits.remove(cut);
        splits.extend(split(&parts));
        charts.remove(cut);
        charts.extend(parts);
        let value = draft.fill() - PRICE * settings.seam_weight * seam;
        worse += 1;
        if value > best.0 {
            best = (value, charts.clone(), draft.clone());
            worse = 0;
        }
        if worse == PATIENCE {
            break;
        }
    }
    let (_, charts, draft) = best;
    Ok(Drafted {
        charts,
        draft: Some(draft),
    })
}

/// The chart that a cut is worth most for, the first of equals, and the cut.
fn most_worth(splits: &[Option<Split>]) -> Option<(usize, &Split)> {
    let cuts = splits.iter().enumerate().rev();
    let cuts = cuts.filter_map(|(chart, split)| Some((chart, split.as_ref()?)));
    cuts.max_by(|a, b| a.1.worth.total_cmp(&b.1.worth))
}
