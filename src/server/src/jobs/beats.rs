//! Heartbeats, which also carry client commands back to the attempts.

use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};

use super::meters;
use super::queue::Jobs;

impl Jobs {
    /// Sends heartbeats for all attempts of this process every `interval`, and passes the answers on to them. Never
    /// returns.
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
