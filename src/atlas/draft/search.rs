//! The search for a fuller layout.
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{Draft, squeezed_side};
use crate::atlas::OnRead;
use crate::atlas::arrangement::Arrangement;
use crate::atlas::read_limit::ReadLimit;
use crate::atlas::squeeze::Body;
use crate::numerics::random::Random;

/// Charts from which on a search reads all the words it may.
const MANY: u64 = 8;
/// Searches from different seeds.
const SEEDS: usize = 4;
/// Larger squares that a search accepts at its begin and at its end: about half a cell and a tenth of one.
const TEMPERATURES: [f64; 2] = [0.65, 0.13];
/// What a trial costs for each chart beside the words it reads.
const WORDS_PER_CHART: u64 = 1000;

impl Draft {
    /// The drafts that several searches make of this one, together reading about so many words; the best first.
    pub(in crate::atlas) fn searched(&self, words: u64, on_read: &OnRead) -> Vec<Self> {
        let words = words / SEEDS as u64;
        let seeds = (0..SEEDS).into_par_iter().with_max_len(1);
        let mut drafts: Vec<Self> = seeds
            .map(|seed| {
                let mut draft = self.clone();
                draft.improve(words / 4, seed as u64, on_read);
                draft.relocate(words / 4 * 3, seed as u64, on_read);
                draft
            })
            .collect();
        drafts.sort_by(|a, b| a.side().total_cmp(&b.side()));
        drafts
    }

    /// Searches a smaller square; reads about so many words, less of few charts.
    ///
    /// The squeezed layout never gets worse, on pages that are not square the arrangement does not; the arrangement from which a
    /// squeezed layout comes may, so that searches that follow each other begin at different ones.
    pub fn improve(&mut self, words: u64, seed: u64, on_read: &OnRead) {
        let told = AtomicU64::new(0);
        let count = |read| {
            told.fetch_add(read, Ordering::Relaxed);
            on_read(read)
        };
        self.improve_within(words, seed, &count);
        // What it need not read is as good as read.
        on_read(words.saturating_sub(told.into_inner()));
    }

    fn improve_within(&mut self, words: u64, seed: u64, on_read: &OnRead) {
        if self.state.order.is_empty() {
            return;
        }
        let found = self.annealed(words, &mut Random::new(seed), on_read);
        if !self.raster.is_square() {
            if found.cost < self.state.cost {
                self.state = found;
            }
            return;
        }
        self.state = found;
        let mut pages = self.loose();
        let each = words / 2 / pages.len() as u64;
        for page in &mut pages {
            page.squeezed
                .settle(&self.bodies(&page.charts), each, on_read);
        }
        if squeezed_side(&pages) < squeezed_side(&self.pages) {
            self.pages = pages;
        }
    }

    /// The best arrangement that is found while about so many words are read.
    fn annealed(&self, words: u64, random: &mut Random, on_read: &OnRead) -> Arrangement {
        // A few charts have few layouts.
        let n = (self.poses.len() as u64).min(MANY);
        let words = words * n * n / (MANY * MANY);
        let largest = self.state.side + self.state.side / 16;
        let mut sheet = self.raster.sheet(largest);
        let mut state = self.state.clone();
        let mut best: Option<Arrangement> = None;
        let [first, last] = TEMPERATURES;
        let mut limit = ReadLimit::new(words, on_read);
        while limit.admits(sheet.work) {
            let progress = sheet.work as f64 / words as f64;
            let temperature = first * (last / first).powf(progress);
            let bound = state.cost - temperature * (1.0 - random.unit()).ln();
            let mut trial = state.clone();
            let first = trial.change(random);
            sheet.work += WORDS_PER_CHART * trial.order.len() as u64;
            let fits = trial.lay_out(&self.poses, &mut sheet, first, largest.min(bound as u32));
            if fits.is_some() && trial.cost <= bound {
                state = trial;
                if best.as_ref().is_none_or(|best| state.cost < best.cost) {
                    best = Some(state.clone());
                }
            }
        }
        best.unwrap_or(state)
    }

    /// Lets charts look for other places while about so many words are read.
    fn relocate(&mut self, words: u64, seed: u64, on_read: &OnRead) {
        let mut pages = std::mem::take(&mut self.pages);
        let each = words / pages.len().max(1) as u64;
        for page in &mut pages {
            let bodies = self.bodies(&page.charts);
            page.squeezed.search(&bodies, each, seed, on_read);
        }
        self.pages = pages;
    }

    fn bodies(&self, charts: &[usize]) -> Vec<Arc<Body>> {
        charts
            .iter()
            .map(|&chart| self.poses[chart].body())
            .collect()
    }
}
