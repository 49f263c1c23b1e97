//! Search for a fuller layout: simulated annealing, then squeezing, from several seeds.
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::CoarseLayout;
use super::arrangement::{Arrangement, Prefixes};
use crate::atlas::effort::{Effort, OnRead, ReadLimit};
use crate::atlas::squeeze::{Body, End, Squeezed};
use unwrapd_method::numerics::random::Random;

/// Share of the words for annealing; the rest is for squeezing.
const ANNEALING: f64 = 0.6;
/// Maximum number of the best arrangements that are squeezed. With one, three charts lose .03 of fill at some of their angles
/// (`optima::charts_that_lie_rotated_fill_as_much`); a third one makes one layout of 25 fuller, for a tenth of the time.
const SQUEEZED: usize = 2;
/// Temperatures at the start and the end of annealing: the mean increase in cost, in cells, up to which a trial is accepted.
const TEMPERATURES: [f64; 2] = [0.25, 0.05];
/// Cost of a trial for each large chart besides the words it reads, in words.
const WORDS_PER_CHART: u64 = 375;
/// Number of trials in a row, all made before, for each large chart, after which the next one is accepted whatever its cost: the
/// arrangements around the present one are known. With 16, two of 183 sets of charts (`tests/bench/stable.rs`) are emptier by .025 and .035,
/// and none is fuller by more than .002.
const STUCK: usize = 4;
/// Number of such steps in a row without a new arrangement after which a search ends: almost surely nothing is left to try.
const IN_VAIN: usize = 5;
/// Distance between the seeds of two searches, at least the number of starts of one.
const SEEDS_PER_SEARCH: u64 = 100;
/// Number of small charts that cost as much as a large one.
const SMALL_PER_LARGE: usize = 4;

impl CoarseLayout {
    /// Returns the number of charts, where several small ones count as one. The effort of a search depends on it.
    pub fn n_charts(&self) -> usize {
        let small = self.state.order.len() - self.n_large.min(self.state.order.len());
        self.n_large + small.div_ceil(SMALL_PER_LARGE)
    }

    /// Searches for a fuller layout from new seeds, and keeps the present one if none is found. Reads about `words` words, or fewer if
    /// nothing is left to try. Does nothing for a crowd.
    pub fn improve(&mut self, effort: Effort, words: u64, on_read: &OnRead) {
        let told = AtomicU64::new(0);
        let count = |read| {
            told.fetch_add(read, Ordering::Relaxed);
            on_read(read)
        };
        self.improve_within(effort, words, &count);
        // Words that were not needed count as read.
        on_read(words.saturating_sub(told.into_inner()));
    }

    fn improve_within(&mut self, effort: Effort, words: u64, on_read: &OnRead) {
        let is_laid_out = self.is_laid_out() || self.lay_out();
        if self.state.order.is_empty()
            || !is_laid_out
            || self.is_exhausted
            || self.is_least()
            || self.is_crowded()
        {
            return;
        }
        let annealing = ANNEALING * words as f64;
        let found = self.arrangements(effort, annealing, on_read);
        self.n_searches += 1;
        let each = ((words as f64 - annealing) / found.len() as f64) as u64;
        let squeezed: Vec<(Option<Squeezed>, End)> = (found.par_iter().with_max_len(1))
            .map(|state| self.squeezed(state, each, on_read))
            .collect();
        for (state, (squeezed, end)) in found.into_iter().zip(squeezed) {
            if end == End::Stuck {
                self.squeezed_to_the_end.push(state.clone());
            }
            if let Some(squeezed) =
                squeezed.filter(|it| !self.is_searched() || it.side < self.side())
            {
                (self.state, self.squeezed) = (state, Some(squeezed));
            }
        }
    }

    /// Returns the least side of an arrangement, in cells: a mask covers each cell that its rectangle reaches.
    fn least_cells(&self) -> u32 {
        self.least_side() as u32 + 1
    }

    /// Anneals from several seeds, and reads about `words` words in all. Returns the best arrangements that have not been squeezed
    /// before, the best first.
    fn arrangements(&mut self, effort: Effort, words: f64, on_read: &OnRead) -> Vec<Arrangement> {
        let each = (words / f64::from(effort.starts())) as u64;
        let first_seed = SEEDS_PER_SEARCH * self.n_searches;
        let starts = (0..effort.starts()).into_par_iter().with_max_len(1);
        let found: Vec<(Arrangement, bool)> = starts
            .map(|start| {
                let mut random = Random::new(first_seed + u64::from(start));
                self.annealed(each, &mut random, on_read)
            })
            .collect();
        self.is_exhausted = found.iter().all(|(_, is_exhausted)| *is_exhausted);
        let mut found: Vec<Arrangement> = found.into_iter().map(|(state, _)| state).collect();
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found.dedup_by(|other, better| better.lies_like(other));
        found.truncate(SQUEEZED);
        let known = &self.squeezed_to_the_end;
        found.retain(|state| known.iter().all(|it| !it.lies_like(state)));
        found
    }

    /// Returns the charts of an arrangement, squeezed, and how squeezing ended; `None` if they could not be separated.
    fn squeezed(
        &self,
        state: &Arrangement,
        words: u64,
        on_read: &OnRead,
    ) -> (Option<Squeezed>, End) {
        let mut squeezed = self.loose(state);
        let bodies: Vec<Arc<Body>> = (self.first.order.iter())
            .map(|&chart| self.poses[chart].body())
            .collect();
        let end = squeezed.settle(&bodies, words, on_read);
        (Some(squeezed).filter(|_| end != End::Overlapping), end)
    }

    /// Returns the best arrangement found while about `words` words are read, and whether nothing is left to try. Starts with the
    /// largest charts first.
    ///
    /// Only the large charts change their order and poses. The small ones are placed once, at the end.
    fn annealed(&self, words: u64, random: &mut Random, on_read: &OnRead) -> (Arrangement, bool) {
        let (large, all) = (self.n_large, self.state.order.len());
        // Room for worse trials, and for the small charts, which are placed last.
        let largest = self.first.side + self.first.side / 4;
        let mut occupancy = self.raster.occupancy(largest);
        let mut prefixes = Prefixes::new(occupancy.clone());
        let mut state = self.first.clone();
        if large < all
            && state
                .lay_out(&self.poses, &mut occupancy, 0..large, largest)
                .is_none()
        {
            return (state, true);
        }
        let mut best = state.clone();
        let mut known = HashSet::from([state.key(&self.plan.kind)]);
        let [first, last] = TEMPERATURES;
        let mut limit = ReadLimit::new(words, on_read);
        // Number of trials in a row that were made before.
        let (mut known_in_row, stuck) = (0, STUCK * large);
        let least = self.least_cells();
        while limit.admits(occupancy.work) && known_in_row < IN_VAIN * stuck && best.side > least {
            let progress = occupancy.work as f64 / words as f64;
            let temperature = first * (last / first).powf(progress);
            let is_stuck = known_in_row % stuck == stuck - 1;
            let bound = if is_stuck {
                f64::INFINITY
            } else {
                state.cost - temperature * (1.0 - random.unit()).ln()
            };
            let most = largest.min(bound as u32);
            let mut trial = state.clone();
            let (place, is_fitted) = trial.change(large, &self.poses, random);
            if is_fitted {
                prefixes.hold(&mut occupancy, &state, &self.poses, place);
                occupancy.capacity = most;
                trial.fit(place, &self.poses, &mut occupancy, random);
            }
            let first = trial.copy_pose(place, &self.plan.kind);
            if known.insert(trial.key(&self.plan.kind)) {
                known_in_row = 0;
            } else {
                known_in_row += 1;
                if !is_stuck {
                    continue;
                }
            }
            occupancy.work += WORDS_PER_CHART * large as u64;
            if !is_fitted || first != place {
                prefixes.hold(&mut occupancy, &state, &self.poses, first);
            }
            let fits = trial.lay_out(&self.poses, &mut occupancy, first..large, most);
            if fits.is_some() && trial.cost <= bound {
                state = trial;
                prefixes.change(first);
                if state.cost < best.cost {
                    best = state.clone();
                }
            }
        }
        prefixes.hold(&mut occupancy, &state, &self.poses, 0);
        best.take(&self.poses, &mut occupancy, 0..large);
        let placed = large == all
            || (best.lay_out(&self.poses, &mut occupancy, large..all, largest)).is_some();
        let best = if placed { best } else { self.first.clone() };
        (best, known_in_row >= IN_VAIN * stuck)
    }
}
