//! Timing of the stages.

use super::tracker::Tracker;

/// Stopwatch on the observer's clock. Laps are in seconds.
pub(super) struct StopWatch<'a> {
    tracker: &'a Tracker<'a>,
    last: f64,
}

impl<'a> StopWatch<'a> {
    pub(super) fn start(tracker: &'a Tracker<'a>) -> Self {
        Self {
            tracker,
            last: tracker.elapsed().as_secs_f64(),
        }
    }

    pub(super) fn lap(&mut self) -> f64 {
        let now = self.tracker.elapsed().as_secs_f64();
        now - std::mem::replace(&mut self.last, now)
    }
}
