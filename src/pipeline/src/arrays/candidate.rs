//! Candidate charts of an atlas, and the search for the one with the fullest layout.

use super::chart_maps::chart_maps;
use rayon::prelude::*;
use std::sync::Arc;
use unwrapd_layout::atlas::{AtlasError, AtlasOptions, Draft, Look, OnRead};
use unwrapd_layout::charts::MappedChart;

/// Maximum cost of cuts, as a share of the square.
pub const MOST_COST: f64 = 1.0;
/// Looks at candidates, one after another, each with the number of best candidates that get it.
pub const LOOKS: [(Look, usize); 3] = [
    (Look::First, usize::MAX),
    (Look::Second, 4),
    (Look::Last, 2),
];
/// [`LOOKS`] for charts that were cut for fewer pages before.
pub const LOOKS_FURTHER: [(Look, usize); 3] = [
    (Look::First, usize::MAX),
    (Look::Second, 4),
    (Look::Last, 1),
];

/// Least factor over the scale reached on fewer pages at which a layout is worth looking for.
const WORTHWHILE: f64 = 1.005;

/// Charts after some cuts.
#[derive(Clone)]
pub struct Candidate {
    pub charts: Vec<Arc<MappedChart>>,
    pub draft: Draft,
    /// Cost of the cuts, as a share of the square.
    pub cost: f64,
    /// Share of the square that the charts must fill, if a scale is given.
    pub wanted: Option<f64>,
}

impl Candidate {
    /// Returns the share of the square that is filled, minus the cost of the cuts. If a scale is given, fill beyond
    /// the wanted share is worth nothing, and charts that reach that share are worth more than any that do not.
    fn value(&self) -> f64 {
        let fill = self.draft.fill();
        match self.wanted {
            None => fill - self.cost,
            Some(wanted) if fill < wanted => fill - wanted - MOST_COST,
            Some(_) => -self.cost,
        }
    }

    /// Returns whether the charts may exceed `scale` by the worthwhile factor.
    fn may_exceed(&self, scale: f64) -> bool {
        self.draft.most_scale() >= WORTHWHILE * scale
    }

    /// Replaces charts by their parts, at `cost` each; `parted` lists the last chart first.
    pub fn cut(
        &self,
        parted: Vec<(usize, Vec<MappedChart>)>,
        cost: f64,
    ) -> Result<Cut, AtlasError> {
        let mut candidate = self.clone();
        let mut replaced = Vec::new();
        for (place, parts) in parted {
            candidate.draft = candidate.draft.replaced(place, &chart_maps(&parts))?;
            candidate.cost += cost;
            candidate.charts.remove(place);
            candidate.charts.extend(parts.into_iter().map(Arc::new));
            replaced.push(place);
        }
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
/// All are looked at briefly, the best of them again, and the best of those for long.
/// From: Karnin, Koren, Somekh 2013, Almost Optimal Exploration in Multi-Armed Bandits (successive halving).
pub struct Search<'a> {
    pub options: &'a AtlasOptions,
    pub on_read: &'a OnRead<'a>,
    looks: &'static [(Look, usize)],
    /// Scale that was reached before.
    reached: f64,
    /// Multiple of the words that looks usually read.
    effort: f64,
}

impl<'a> Search<'a> {
    /// Creates a search that starts from `n_charts` charts and allows `most_cuts` cuts. `looks` are the looks to
    /// take, and `reached` is the scale that was reached before.
    pub fn new(
        (n_charts, most_cuts): (usize, usize),
        (looks, reached): (&'static [(Look, usize)], f64),
        options: &'a AtlasOptions,
        on_read: &'a OnRead<'a>,
    ) -> Self {
        let numbers: Vec<usize> = (n_charts..=n_charts + most_cuts).collect();
        let patience = options.patience as f64;
        let wanted = patience * wanted_words(&numbers, looks) as f64;
        let share = options.search_words as f64 / wanted.max(1.0);
        Self {
            options,
            on_read,
            looks,
            reached,
            effort: patience * share.min(1.0),
        }
    }

    /// Looks at a candidate.
    fn look(&self, candidate: &mut Candidate, look: Look) {
        let words = self.effort * look.words(candidate.draft.n_charts()) as f64;
        candidate.draft.improve(look, words as u64, self.on_read);
    }

    /// Removes candidates that cannot exceed the scale reached before and takes the first look at the others. Returns
    /// the best value.
    pub fn most_valued(&self, candidates: &mut Vec<Candidate>) -> f64 {
        candidates.retain(|candidate| candidate.may_exceed(self.reached));
        let each = candidates.par_iter_mut().with_max_len(1);
        each.for_each(|candidate| self.look(candidate, Look::First));
        let values = candidates.iter().map(Candidate::value);
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the most valuable of the candidates, which have had their first look, with a full layout of it; `None`
    /// if there are no candidates.
    pub fn fullest(&self, mut candidates: Vec<Candidate>) -> Option<Candidate> {
        let by_value = |a: &Candidate, b: &Candidate| b.value().total_cmp(&a.value());
        candidates.sort_by(by_value);
        let again = |&&(look, _): &&(Look, usize)| look != Look::First;
        for &(look, n) in self.looks.iter().filter(again) {
            candidates.truncate(n);
            let each = candidates.par_iter_mut().with_max_len(1);
            each.for_each(|candidate| self.look(candidate, look));
            candidates.sort_by(by_value);
        }
        let best = candidates.into_iter().next()?;
        let straight = self.straightened(&best);
        Some(straight.unwrap_or(best))
    }

    /// Returns the candidate with leaning charts turned upright, if the layout stays about as full.
    fn straightened(&self, best: &Candidate) -> Option<Candidate> {
        let mut straight = Candidate {
            draft: best.draft.straightened()?,
            ..best.clone()
        };
        for look in [Look::Second, Look::Last] {
            self.look(&mut straight, look);
        }
        (straight.value() >= best.value() - Draft::STRAIGHT).then_some(straight)
    }
}

/// Returns the number of words that looks at candidates with these numbers of charts read, if those with the most
/// charts are the best.
pub fn wanted_words(numbers: &[usize], looks: &[(Look, usize)]) -> u64 {
    let words = |&(look, n): &(Look, usize)| -> u64 {
        let best = &numbers[numbers.len().saturating_sub(n)..];
        best.iter().map(|&n_charts| look.words(n_charts)).sum()
    };
    looks.iter().map(words).sum()
}
