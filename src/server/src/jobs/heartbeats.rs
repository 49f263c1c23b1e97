//! Heartbeats, which also carry client commands back to the attempts.

use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};

use super::meters;
use super::queue::Jobs;

impl Jobs {
    /// Sends heartbeats for all attempts of this process every `interval`, and passes the answers on to them. Never
    /// returns.
    pub(super) async fn send_heartbeats(&self, interval: Duration) {
        let mut interval = tokio::time::interval(interval);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            interval.tick().await;
            let heartbeats = self.running.heartbeats();
            if heartbeats.is_empty() {
                continue;
            }
            let lease_end = Instant::now() + self.settings.rules.lease;
            match self.store.heartbeat(&heartbeats).await {
                Ok(answers) => {
                    for (heartbeat, changed) in heartbeats.iter().zip(&answers) {
                        self.running.answered(heartbeat, changed, lease_end);
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
