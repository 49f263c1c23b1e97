//! Jobs that are watched, wherever they run.

use std::collections::HashMap;

use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use super::access::Reach;
use super::job::JobId;
use super::queue::Jobs;
use super::store_error::StoreResult;
use super::subscription::Subscription;

impl Jobs {
    /// Watches a job; `None` if there is none.
    pub async fn subscribe(&self, reach: &Reach, id: JobId) -> StoreResult<Option<Subscription>> {
        // What happens after this line is seen, so that no end can fall between it and the record.
        let subscription = self.live.subscribe(id);
        // Others may watch what is out of reach: they go on.
        let Some(job) = self.get(reach, id).await? else {
            return Ok(None);
        };
        self.live.publish(id, job.event());
        Ok(Some(subscription))
    }

    /// Reads the records of watched jobs from time to time until told to stop.
    pub(super) async fn watch_until(&self, stop: &CancellationToken) {
        let mut interval = tokio::time::interval(self.settings.deployment.look_interval());
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            let ids = self.live.ids();
            if ids.is_empty() {
                continue;
            }
            match self.store.events(&ids).await {
                Ok(events) => {
                    let events: HashMap<_, _> = events.into_iter().collect();
                    for id in ids {
                        match events.get(&id) {
                            Some(&event) => self.live.publish(id, event),
                            None => self.live.forget(id),
                        }
                    }
                }
                Err(error) => tracing::warn!(%error, "records of watched jobs not read"),
            }
        }
    }
}
