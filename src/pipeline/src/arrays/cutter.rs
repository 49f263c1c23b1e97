//! Cutting of charts one by one, where that makes their atlas fuller.

use super::candidate::{Candidate, MOST_COST, Search};
use super::expected_fill::{Extent, expected_fill};
use super::objective::Objective;
use rayon::prelude::*;
use std::sync::Arc;
use unwrapd_layout::atlas::{AtlasError, CoarseLayout, OnRead, Scale, Texture};
use unwrapd_layout::charts::{MappedChart, Split, parted_alike};
use unwrapd_method::solver::Control;

/// Candidates differ by one cut, plus one per `CHARTS_PER_CUT` charts beyond `CHARTS_OF_ONE_CUT`: among many charts,
/// one cut changes little.
const CHARTS_PER_CUT: usize = 16;
const CHARTS_OF_ONE_CUT: usize = 64;
/// Number of words that the search for one more cut counts for.
pub const WORDS_PER_CUT: u64 = 1_000_000;

/// Cuts charts one by one.
pub struct Cutter<'a> {
    pub search: &'a Search<'a>,
    /// The current charts.
    pub candidate: Candidate,
    /// Most valuable cut of each chart.
    splits: Vec<Option<Split>>,
    /// The extent of each chart.
    extents: Vec<Extent>,
    /// The square root of a page's area.
    of_page: f64,
    objective: Objective,
    most_charts: usize,
}

impl<'a> Cutter<'a> {
    pub fn new(
        charts: Vec<MappedChart>,
        (layout, elsewhere): (CoarseLayout, Vec<CoarseLayout>),
        objective: Objective,
        most_charts: usize,
        search: &'a Search<'a>,
    ) -> Self {
        let options = search.options;
        let area = charts.iter().map(MappedChart::area).sum::<f64>();
        let Texture { resolution, pages } = options.texture;
        let [shorter, longer] = [resolution.shorter(), resolution.longer()].map(f64::from);
        // A chart has to fit across a page that is not square, but may be longer than it is wide.
        let of_page = (area / f64::from(pages) * (shorter / longer).sqrt()).sqrt();
        let charts: Vec<_> = charts.into_iter().map(Arc::new).collect();
        Self {
            search,
            splits: best_splits(&charts, of_page, search.on_read),
            extents: charts.iter().map(|chart| Extent::of(chart)).collect(),
            candidate: Candidate {
                charts,
                layout,
                elsewhere,
                seams: objective.seams,
                cost: 0.0,
                wanted: match options.scale {
                    Scale::Largest => None,
                    Scale::TexelsPerUnit(texels) => {
                        Some(area * texels * texels / (shorter * longer * f64::from(pages)))
                    }
                },
            },
            of_page,
            objective,
            most_charts,
        }
    }

    /// Returns the share of the square that is expected to be filled, minus the cost of the cuts.
    pub fn expected_value(&self) -> f64 {
        expected_fill(&self.extents, self.objective.pages) - self.candidate.cost
    }

    /// Makes the next most valuable cuts and returns the charts; `None` if no chart can be cut or no cut is worth it.
    pub fn next(&mut self) -> Result<Option<Candidate>, AtlasError> {
        let n_charts = self.candidate.layout.n_charts();
        let n_cuts = 1 + n_charts.saturating_sub(CHARTS_OF_ONE_CUT) / CHARTS_PER_CUT;
        for i in 0..n_cuts {
            if !self.cut()? {
                return Ok((i > 0).then(|| self.candidate.clone()));
            }
        }
        Ok(Some(self.candidate.clone()))
    }

    /// Makes the most valuable cut; returns `false` if there is none.
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
        let cut = candidate.cut(parted, split.length, &self.objective)?;
        if cut.candidate.charts.len() > self.most_charts {
            return Ok(false);
        }
        for &place in &cut.replaced {
            self.splits.remove(place);
            self.extents.remove(place);
        }
        *candidate = cut.candidate;
        let new = &candidate.charts[self.splits.len()..];
        (self.splits).extend(best_splits(new, self.of_page, on_read));
        (self.extents).extend(new.iter().map(|chart| Extent::of(chart)));
        Ok(true)
    }
}

fn best_splits(charts: &[Arc<MappedChart>], unit: f64, on_read: &OnRead) -> Vec<Option<Split>> {
    let each = charts.par_iter().with_max_len(1);
    each.map(|chart| chart.best_split(unit, &|| on_read(0)))
        .collect()
}

/// Returns the chart with the most valuable cut, the first of equals, and the cut.
fn most_worth(splits: &[Option<Split>]) -> Option<(usize, &Split)> {
    let cuts = splits.iter().enumerate().rev();
    let cuts = cuts.filter_map(|(chart, split)| Some((chart, split.as_ref()?)));
    cuts.max_by(|a, b| a.1.worth.total_cmp(&b.1.worth))
}
