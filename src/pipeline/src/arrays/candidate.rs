//! Candidate charts of an atlas, and the search for the one with the fullest layout.

use super::chart_maps::chart_maps;
use super::objective::Objective;
use rayon::prelude::*;
use std::sync::Arc;
use unwrapd_layout::atlas::{AtlasError, AtlasOptions, CoarseLayout, Effort, OnRead};
use unwrapd_layout::charts::MappedChart;

/// Maximum cost of cuts, as a share of the square.
pub const MOST_COST: f64 = 1.0;
/// Rounds of the search: in each, the given number of best candidates get the effort.
pub const ROUNDS: [(Effort, usize); 3] = [
    (Effort::Low, usize::MAX),
    (Effort::Medium, 4),
    (Effort::High, 2),
];
/// [`ROUNDS`] for charts that were cut for fewer pages before.
pub const ROUNDS_FURTHER: [(Effort, usize); 3] = [
    (Effort::Low, usize::MAX),
    (Effort::Medium, 4),
    (Effort::High, 1),
];

/// Least factor over the scale reached on fewer pages at which a layout is worth looking for.
const WORTHWHILE: f64 = 1.005;

/// Charts after some cuts.
#[derive(Clone)]
pub struct Candidate {
    pub charts: Vec<Arc<MappedChart>>,
    pub layout: CoarseLayout,
    /// Layouts of the same charts on longer pages, where one of the charts is too long for the page that is asked for.
    pub elsewhere: Vec<CoarseLayout>,
    /// Length of all seams.
    pub seams: f64,
    /// Cost of the cuts, as a share of the square.
    pub cost: f64,
    /// Share of the square that the charts must fill, if a scale is given.
    pub wanted: Option<f64>,
}

impl Candidate {
    /// Returns the share of the square that is filled, minus the cost of the cuts. If a scale is given, fill beyond
    /// the wanted share is worth nothing, and charts that reach that share are worth more than any that do not.
    fn value(&self) -> f64 {
        let fill = self.fill();
        match self.wanted {
            None => fill - self.cost,
            Some(wanted) if fill < wanted => fill - wanted - MOST_COST,
            Some(_) => -self.cost,
        }
    }

    /// Returns the share of a page that is filled: the mean of the page that is asked for and the best of all.
    fn fill(&self) -> f64 {
        let here = self.layout.fill();
        let elsewhere = self.elsewhere.iter().map(CoarseLayout::fill);
        f64::midpoint(here, elsewhere.fold(here, f64::max))
    }

    /// Returns whether the charts may exceed `scale` by the worthwhile factor.
    fn may_exceed(&self, scale: f64) -> bool {
        self.layout.most_scale() >= WORTHWHILE * scale
    }

    /// Replaces charts by their parts, along seams of a given length each; `parted` lists the last chart first.
    pub fn cut(
        &self,
        parted: Vec<(usize, Vec<MappedChart>)>,
        length: f64,
        objective: &Objective,
    ) -> Result<Cut, AtlasError> {
        let mut candidate = self.clone();
        let mut replaced = Vec::new();
        for (place, parts) in parted {
            let maps = chart_maps(&parts);
            candidate.layout = candidate.layout.replaced(place, &maps)?;
            for layout in &mut candidate.elsewhere {
                *layout = layout.replaced(place, &maps)?;
            }
            candidate.seams += length;
            candidate.charts.remove(place);
            candidate.charts.extend(parts.into_iter().map(Arc::new));
            replaced.push(place);
        }
        candidate.cost = objective.cost_of_cuts(candidate.seams, candidate.charts.len());
        Ok(Cut {
            candidate,
            replaced,
        })
    }
}

/// A candidate after one more cut, and the places of the charts that were cut, the last first.
pub struct Cut {
    pub candidate: Candidate,
    pub replaced: Vec<usize>,
}

/// A search for the most valuable candidate.
///
/// All get a low effort, the best of them a medium one, and the best of those a high one.
/// From: Karnin, Koren, Somekh 2013, Almost Optimal Exploration in Multi-Armed Bandits (successive halving).
pub struct Search<'a> {
    pub options: &'a AtlasOptions,
    pub on_read: &'a OnRead<'a>,
    rounds: &'static [(Effort, usize)],
    /// Scale that was reached before.
    reached: f64,
    /// Share of the words that an effort usually reads.
    share: f64,
}

impl<'a> Search<'a> {
    /// Creates a search that starts from `n_charts` charts and allows `most_cuts` cuts. `rounds` are its
    /// rounds, and `reached` is the scale that was reached before.
    pub fn new(
        (n_charts, most_cuts): (usize, usize),
        (rounds, reached): (&'static [(Effort, usize)], f64),
        options: &'a AtlasOptions,
        on_read: &'a OnRead<'a>,
    ) -> Self {
        let numbers: Vec<usize> = (n_charts..=n_charts + most_cuts).collect();
        let patience = options.patience as f64;
        let wanted = patience * wanted_words(&numbers, rounds) as f64;
        let share = options.budget_words as f64 / wanted.max(1.0);
        Self {
            options,
            on_read,
            rounds,
            reached,
            share: share.min(1.0),
        }
    }

    /// Improves the layout of a candidate.
    fn improve(&self, candidate: &mut Candidate, effort: Effort) {
        let words = self.share * effort.words(candidate.layout.n_charts()) as f64;
        for _ in 0..self.options.patience {
            candidate.layout.improve(effort, words as u64, self.on_read);
            // Of other pages only the fill is of interest, which the first effort shows, and only that of the fullest.
            let mut fullest = candidate.layout.fill();
            for layout in (candidate.elsewhere.iter_mut()).filter(|_| effort == Effort::Low) {
                if layout.most_fill() > fullest {
                    layout.improve(effort, words as u64, self.on_read);
                    fullest = fullest.max(layout.fill());
                }
            }
        }
    }

    /// Removes candidates that cannot exceed the scale reached before and gives the others the first effort. Returns
    /// the best value.
    pub fn most_valued(&self, candidates: &mut Vec<Candidate>) -> f64 {
        candidates.retain(|candidate| candidate.may_exceed(self.reached));
        let each = candidates.par_iter_mut().with_max_len(1);
        each.for_each(|candidate| self.improve(candidate, Effort::Low));
        let values = candidates.iter().map(Candidate::value);
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the most valuable of the candidates, which got the first effort, with a full layout of it; `None`
    /// if there are no candidates.
    pub fn fullest(&self, mut candidates: Vec<Candidate>) -> Option<Candidate> {
        let by_value = |a: &Candidate, b: &Candidate| b.value().total_cmp(&a.value());
        candidates.sort_by(by_value);
        let again = |&&(effort, _): &&(Effort, usize)| effort != Effort::Low;
        for &(effort, n) in self.rounds.iter().filter(again) {
            candidates.truncate(n);
            let each = candidates.par_iter_mut().with_max_len(1);
            each.for_each(|candidate| self.improve(candidate, effort));
            candidates.sort_by(by_value);
        }
        candidates.into_iter().next()
    }
}

/// Returns the number of words that rounds with candidates of these numbers of charts read, if those with the most
/// charts are the best.
pub fn wanted_words(numbers: &[usize], rounds: &[(Effort, usize)]) -> u64 {
    let words = |&(effort, n): &(Effort, usize)| -> u64 {
        let best = &numbers[numbers.len().saturating_sub(n)..];
        best.iter().map(|&n_charts| effort.words(n_charts)).sum()
    };
    rounds.iter().map(words).sum()
}
