//! Portions of the work of a stage, which report their progress.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::tracker::Tracker;
use unwrapd_layout::charts::{self, MapUnderway};
use unwrapd_method::solver::{Control, Iterate};

/// A portion of the work of a stage with an expected effort.
///
/// Up to [`STEADY`] of the expected work its share grows linearly, beyond that more and more slowly, so that it never
/// appears complete before it is. Dropping the portion completes it.
pub(super) struct Portion<'a> {
    tracker: &'a Tracker<'a>,
    /// Index of its surface.
    surface: usize,
    /// Weight within the stage, in the unit of the stage.
    weight: f64,
    /// Expected work, in a unit of its own.
    expected: f64,
    done: Mutex<f64>,
    /// Numbers of mapped and of known charts.
    charts: Mutex<[isize; 2]>,
}

/// Expected Newton steps for a surface, and for a chart. Only the progress shown depends on them.
const STEPS_OF_SURFACE: f64 = 12.0;
const STEPS_OF_CHART: f64 = 15.0;

/// Share of the expected work up to which a portion advances linearly. A larger share fits exact expectations, a
/// smaller one leaves more room for work beyond them.
const STEADY: f64 = 0.7;

impl<'a> Portion<'a> {
    /// Creates the portion of an atlas: `words` budgeted, `expected` likely. The unit is a 64-bit word read while
    /// packing.
    pub fn of_atlas(tracker: &'a Tracker, words: u64, expected: u64) -> Self {
        Self::of(tracker, 0, [words as f64, expected as f64])
    }

    /// Creates the portion of a surface of `faces` faces that is cut and mapped until it keeps a bound.
    pub fn of_surface(tracker: &'a Tracker, surface: usize, faces: usize) -> Self {
        let faces = faces as f64;
        Self::of(tracker, surface, [faces, STEPS_OF_SURFACE * faces])
    }

    /// Creates the portion of a chart of `faces` faces that is mapped once.
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

    /// Records that `words` more words were read. Returns whether to continue.
    pub fn read(&self, words: u64) -> Control {
        let gained = self.weight * self.gained(words as f64);
        self.tracker.advance(gained)
    }

    /// Records that everything is mapped, and that `charts` charts resulted.
    pub fn all_mapped(&self, charts: usize) {
        let [mapped, known] = *self.charts.lock().unwrap_or_else(PoisonError::into_inner);
        let n = charts as isize;
        charts::Observer::charted(self, n - mapped, n - known);
    }

    /// Records that `islands` more islands keep borders bent that were to become straight.
    pub fn bent(&self, islands: usize) {
        self.tracker.bent(islands);
    }

    /// Records more work.
    pub fn advance(&self, work: f64) {
        self.tracker.advance(self.weight * self.gained(work));
    }

    /// Adds work and returns the gain of the share.
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

/// Observes the mapping of some charts. The unit of work is one Newton step of one face.
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
