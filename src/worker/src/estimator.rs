//! Estimated progress between two reports.

use std::time::Duration;

/// Fraction of the speed so far at which the estimate advances between reports, so that a report rarely finds it
/// ahead. A larger fraction overtakes the next report more often, a smaller one lags further behind.
const SPEED_SHARE: f64 = 0.5;

/// Maximum lead of the estimate over the last report. A larger lead shows progress for longer without a report, but
/// stands still for longer if it was wrong.
const MOST_AHEAD: f64 = 0.05;

/// Highest share that the estimate reaches by speed alone: only a report may say that the work is done.
const MOST: f64 = 0.99;

/// Minimum gain of every estimate, as a fraction of the remaining work. It keeps the displayed share moving in a long
/// silence: at two estimates per second, it takes a tenth of the rest in about 50 s.
const LEAST_GAIN: f64 = 1e-3;

/// Share of the work that is done: reported, or estimated from the speed so far. It never falls, and every estimate
/// exceeds the previous one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Estimator {
    reported: f64,
    at: Duration,
    shown: f64,
}

impl Estimator {
    /// Returns the share after a report, at a time since the work began. A report that repeats the last one counts as
    /// silence.
    pub fn reported(&mut self, share: f64, now: Duration) -> f64 {
        if self.reported < share {
            (self.reported, self.at) = (share, now);
        }
        self.shown = self.shown.max(share);
        self.shown
    }

    /// Returns the estimated share without a new report.
    pub fn estimated(&mut self, now: Duration) -> f64 {
        let speed = self.reported / self.at.as_secs_f64().max(f64::MIN_POSITIVE);
        let silence = now.saturating_sub(self.at).as_secs_f64();
        let ahead = (SPEED_SHARE * speed * silence).min(MOST_AHEAD);
        let least = self.shown + LEAST_GAIN * (1.0 - self.shown);
        self.shown = least.max((self.reported + ahead).min(MOST));
        self.shown
    }
}
