//! Parts of the work of a stage, each of which tells how much of it is done.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::tracker::Tracker;
use unwrapd_layout::charts::{self, MapUnderway};
use unwrapd_method::solver::{Control, Iterate};

/// A part of the work of a stage, of which it is known about how much it takes.
///
/// Up to [`STEADY`] of that its share grows with the work that is done, beyond it more and more slowly, so that it never seems to
/// be at its end before it is. When the portion is dropped its work is done.
pub(super) struct Portion<'a> {
    tracker: &'a Tracker<'a>,
    /// Of which surface it is.
    surface: usize,
    /// What it counts for, in the unit of the stage.
    weight: f64,
    /// Work that it is expected to take, in a unit of its own.
    expected: f64,
    done: Mutex<f64>,
    /// Charts that are mapped, and charts that are known.
    charts: Mutex<[isize; 2]>,
}

/// Newton steps that a surface takes, and a chart.
const STEPS_OF_SURFACE: f64 = 12.0;
const STEPS_OF_CHART: f64 = 15.0;

/// The share of the expected work up to which a portion advances steadily.
const STEADY: f64 = 0.7;

impl<'a> Portion<'a> {
    /// An atlas that counts for so many words, of which some are expected to be read.
    pub fn of_atlas(tracker: &'a Tracker, words: u64, expected: u64) -> Self {
        Self::of(tracker, 0, [words as f64, expected as f64])
    }

    /// A surface of so many faces that is cut and mapped until it keeps a bound.
    pub fn of_surface(tracker: &'a Tracker, surface: usize, faces: usize) -> Self {
        let faces = faces as f64;
        Self::of(tracker, surface, [faces, STEPS_OF_SURFACE * faces])
    }

    /// A chart of so many faces of a surface that is mapped once.
    pub fn of_chart(tracker: &'a Tracker, surface: usize, faces: usize) -> Self {
        let faces = faces as f64;
        Self::of(tracker, surface, [faces, STEPS_OF_CHART * faces])
    }

    fn of(tracker: &'a Tracker, surface: usize, [weight, expected]: [f64; 2]) -> Self {
        Self {
            tracker,
            surface,
            weight,
            expected: expected.max(f64::MIN_POSITIVE),
            done: Mutex::new(0.0),
            charts: Mutex::default(),
        }
    }

    /// So many more words are read; whether to go on.
    pub fn read(&self, words: u64) -> Control {
        let gained = self.weight * self.gained(words as f64);
        self.tracker.advance(gained)
    }

    /// All is mapped: that many charts came of it.
    pub fn all_mapped(&self, charts: usize) {
        let [mapped, known] = *self.charts.lock().unwrap_or_else(PoisonError::into_inner);
        let n = charts as isize;
        charts::Observer::charted(self, n - mapped, n - known);
    }

    /// So much more work is done.
    pub fn advance(&self, work: f64) {
        self.tracker.advance(self.weight * self.gained(work));
    }

    /// By how much the share grows with more work.
    fn gained(&self, work: f64) -> f64 {
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let before = share(*done / self.expected);
        *done += work;
        share(*done / self.expected) - before
    }
}

impl Drop for Portion<'_> {
    fn drop(&mut self) {
        let done = *self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let left = 1.0 - share(done / self.expected);
        self.tracker.advance(self.weight * left);
    }
}

fn share(done: f64) -> f64 {
    let rest = 1.0 - STEADY;
    let beyond = (done - STEADY).max(0.0);
    // An exponential would stand still where the work is many times what was expected.
    done.min(STEADY) + rest * beyond / (beyond + rest)
}

/// Sees a part of the charts being mapped; the unit of work is one Newton step of one face.
impl charts::Observer for Portion<'_> {
    fn iterate(&self, faces: usize, iterate: &Iterate) -> Control {
        let gained = self.weight * self.gained(faces as f64);
        self.tracker.iterated(gained, iterate)
    }

    fn map(&self, map: &MapUnderway) {
        self.tracker.map(self.surface, map);
    }

    fn worked(&self, faces: usize) {
        self.advance(faces as f64);
    }

    fn charted(&self, mapped: isize, known: isize) {
        let mut charts = self.charts.lock().unwrap_or_else(PoisonError::into_inner);
        *charts = [charts[0] + mapped, charts[1] + known];
        self.tracker.charted(mapped, known);
    }

    fn control(&self) -> Control {
        self.tracker.control()
    }

    fn elapsed(&self) -> Duration {
        self.tracker.elapsed()
    }
}
