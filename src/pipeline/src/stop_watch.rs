//! How long stages of the work take.

use super::tracker::Tracker;

/// Seconds of the observer's clock from lap to lap.
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
