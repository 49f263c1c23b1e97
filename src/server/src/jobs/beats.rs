//! Signs of life, and what clients want of attempts.

use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};

use super::meters;
use super::queue::Jobs;

impl Jobs {
    /// Gives signs of life for the attempts of this process, and hears what clients want of them,
    /// for ever.
    pub(super) async fn beat(&self, interval: Duration) {
        let mut interval = tokio::time::interval(interval);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            interval.tick().await;
            let beats = self.running.beats();
            if beats.is_empty() {
                continue;
            }
            let lease_end = Instant::now() + self.settings.rules.lease;
            match self.store.beat(&beats).await {
                Ok(answers) => {
                    for (beat, changed) in beats.iter().zip(&answers) {
                        self.running.answered(beat, changed, lease_end);
                    }
                }
                Err(error) => {
                    meters::store_failed();
                    tracing::warn!(%error, "no sign of life given");
                }
            }
        }
    }
}
