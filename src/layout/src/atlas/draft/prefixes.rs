//! Sheets that hold the first charts of an arrangement.
use std::sync::Arc;

use crate::atlas::arrangement::Arrangement;
use crate::atlas::poses::Poses;
use crate::atlas::sheet::Sheet;

/// Sheets at most: with more charts only every second or third has one.
const MOST: usize = 16;

/// For some places of an arrangement a sheet with all charts before it, so that a trial need not take their cells again.
pub(super) struct Prefixes {
    /// Places from one to the next.
    every: usize,
    /// As many as were needed so far.
    sheets: Vec<Sheet>,
}

impl Prefixes {
    /// Of an arrangement of so many charts, on a sheet that is empty.
    pub(super) fn new(empty: Sheet, n_charts: usize) -> Self {
        Self {
            every: n_charts.div_ceil(MOST).max(1),
            sheets: vec![empty],
        }
    }

    /// Makes a sheet hold the charts of an arrangement before a place, and nothing else.
    pub(super) fn hold(
        &mut self,
        sheet: &mut Sheet,
        state: &Arrangement,
        poses: &[Arc<Poses>],
        place: usize,
    ) {
        let nearest = place / self.every;
        while let n = self.sheets.len()
            && n <= nearest
        {
            let mut next = self.sheets[n - 1].clone();
            state.take(poses, &mut next, (n - 1) * self.every..n * self.every);
            self.sheets.push(next);
        }
        sheet.restore(&self.sheets[nearest]);
        state.take(poses, sheet, nearest * self.every..place);
    }

    /// Forgets what is no longer true once the charts from a place on have changed.
    pub(super) fn change(&mut self, place: usize) {
        self.sheets.truncate(place / self.every + 1);
    }
}
