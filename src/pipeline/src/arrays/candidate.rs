//! Charts to choose from, and the search for the fullest layout of any.

use super::chart_maps::chart_maps;
use rayon::prelude::*;
use std::sync::Arc;
use unwrapd_layout::atlas::{AtlasError, AtlasOptions, Draft, Look, OnRead};
use unwrapd_layout::charts::MappedChart;

/// What cuts may cost at most, as a share of the square.
pub const MOST_COST: f64 = 1.0;
/// What a layout may be less full whose charts are all upright that can be.
const STRAIGHT: f64 = 0.01;
/// How candidates are looked at, one look after the other, and how many of the best.
pub const LOOKS: [(Look, usize); 3] = [
    (Look::First, usize::MAX),
    (Look::Second, 4),
    (Look::Last, 2),
];
/// The same where charts were cut for fewer pages before.
pub const LOOKS_FURTHER: [(Look, usize); 3] = [
    (Look::First, usize::MAX),
    (Look::Second, 4),
    (Look::Last, 1),
];

/// By how much a layout has to exceed the scale that was reached on fewer pages to be worth looking for.
const WORTHWHILE: f64 = 1.005;

/// Charts after some cuts.
#[derive(Clone)]
pub struct Candidate {
    pub charts: Vec<Arc<MappedChart>>,
    pub draft: Draft,
    /// What the cuts cost, as a share of the square.
    pub cost: f64,
    /// The share of the square that they have to fill, where a scale is given.
    pub wanted: Option<f64>,
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

    /// Whether its charts may be larger than at this scale by what is worth looking for.
    fn may_exceed(&self, scale: f64) -> bool {
        self.draft.most_scale() >= WORTHWHILE * scale
    }

    /// With the parts of some charts in place of them, the last first, at this cost each.
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

/// A search for the candidate of most value.
///
/// All are looked at briefly, the best of them again, and the best of those for long.
/// From: Karnin, Koren, Somekh 2013, Almost Optimal Exploration in Multi-Armed Bandits (successive halving).
pub struct Search<'a> {
    pub options: &'a AtlasOptions,
    pub on_read: &'a OnRead<'a>,
    looks: &'static [(Look, usize)],
    /// The scale that was reached before.
    reached: f64,
    /// The multiple of the words that looks usually read.
    effort: f64,
}

impl<'a> Search<'a> {
    /// For so many charts, which are cut so often at most, the looks that there are going to be, and a scale that was reached before.
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

    /// Looks at some candidates for the first time, but for those that cannot exceed the scale that was reached; the value of the best.
    pub fn most_valued(&self, candidates: &mut Vec<Candidate>) -> f64 {
        candidates.retain(|candidate| candidate.may_exceed(self.reached));
        let each = candidates.par_iter_mut().with_max_len(1);
        each.for_each(|candidate| self.look(candidate, Look::First));
        let values = candidates.iter().map(Candidate::value);
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The candidate of most value of some that were looked at once, and a full layout of it; none of none.
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

    /// The same charts with those upright that lean, if that leaves the layout as full, about.
    fn straightened(&self, best: &Candidate) -> Option<Candidate> {
        let mut straight = Candidate {
            draft: best.draft.straightened()?,
            ..best.clone()
        };
        for look in [Look::Second, Look::Last] {
            self.look(&mut straight, look);
        }
        (straight.value() >= best.value() - STRAIGHT).then_some(straight)
    }
}

/// The words that looks at candidates of so many charts read, those with most charts being the best.
pub fn wanted_words(numbers: &[usize], looks: &[(Look, usize)]) -> u64 {
    let words = |&(look, n): &(Look, usize)| -> u64 {
        let best = &numbers[numbers.len().saturating_sub(n)..];
        best.iter().map(|&n_charts| look.words(n_charts)).sum()
    };
    looks.iter().map(words).sum()
}
