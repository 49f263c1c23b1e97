//! How far work is between two reports.

use std::time::Duration;

/// Between reports the share goes on at this part of the pace so far, so that a report seldom finds
/// it ahead.
const OF_PACE: f64 = 0.5;

/// How far the estimate may run ahead of the last report.
const MOST_AHEAD: f64 = 0.05;

/// The highest share that pace alone leads to.
const MOST: f64 = 0.99;

/// What it gains in any case, as a share of what is left.
const LEAST_GAIN: f64 = 1e-3;

/// The share of the work that is done: reported, or else estimated from the pace so far. It never
/// falls, and every estimate exceeds what was shown before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pace {
    reported: f64,
    at: Duration,
    shown: f64,
}

impl Pace {
    /// The share after a report, at a time since the work began. One that repeats what was reported
    /// counts as silence.
    pub fn reported(&mut self, share: f64, now: Duration) -> f64 {
        if self.reported < share {
            (self.reported, self.at) = (share, now);
        }
        self.shown = self.shown.max(share);
        self.shown
    }

    /// The share without one.
    pub fn estimated(&mut self, now: Duration) -> f64 {
        let pace = self.reported / self.at.as_secs_f64().max(f64::MIN_POSITIVE);
        let silence = now.saturating_sub(self.at).as_secs_f64();
        let ahead = (OF_PACE * pace * silence).min(MOST_AHEAD);
        let least = self.shown + LEAST_GAIN * (1.0 - self.shown);
        self.shown = least.max((self.reported + ahead).min(MOST));
        self.shown
    }
}
