//! Watching of jobs, wherever they run.

use std::collections::HashMap;
use std::time::Duration;

use tokio::time::MissedTickBehavior;
use tokio_util::bytes::Bytes;
use tokio_util::sync::CancellationToken;

use super::access::Visibility;
use super::job::JobId;
use super::map_feed::MapListener;
use super::queue::Jobs;
use super::settings::Deployment;
use super::store_error::StoreResult;
use super::subscription::Subscription;

/// Number of lookups of the attempt at a job that was just claimed, and the interval between them. The record says
/// `running` a moment before the attempt is registered here. If another process computes the job, the request waits
/// for all lookups in vain: a quarter of a second.
const LOOKUPS: usize = 5;
const LOOKUP_INTERVAL: Duration = Duration::from_millis(50);

/// Answer to a request for the maps of a running job.
pub enum NextMaps {
    /// The bytes of a frame.
    Frame(Bytes),
    /// The attempt has ended.
    Over,
    /// Another process computes the job.
    Elsewhere,
}

impl Jobs {
    /// Subscribes to a job; `None` if there is no such job.
    pub async fn subscribe(
        &self,
        visibility: &Visibility,
        id: JobId,
    ) -> StoreResult<Option<Subscription>> {
        // Subscribe before reading the record, so that no event between the two is missed.
        let subscription = self.live.subscribe(id);
        // Do not end the events of a job outside the caller's scope: others may watch it.
        let Some(job) = self.get(visibility, id).await? else {
            return Ok(None);
        };
        self.live.publish(id, job.event());
        Ok(Some(subscription))
    }

    /// Waits for the next frame of maps after `after`. Frames are only available in the process that computes the
    /// job.
    pub async fn next_maps(&self, id: JobId, after: u64) -> NextMaps {
        let Some(listener) = self.map_listener(id).await else {
            return match self.settings.deployment {
                Deployment::Embedded => NextMaps::Over,
                Deployment::Shared => NextMaps::Elsewhere,
            };
        };
        (listener.next(after).await).map_or(NextMaps::Over, NextMaps::Frame)
    }

    async fn map_listener(&self, id: JobId) -> Option<MapListener> {
        for _ in 0..LOOKUPS {
            if let Some(attempt) = self.running.attempt(id) {
                return Some(attempt.maps.listener());
            }
            tokio::time::sleep(LOOKUP_INTERVAL).await;
        }
        None
    }

    /// Polls the records of watched jobs until stopped.
    pub(super) async fn watch_until(&self, stop: &CancellationToken) {
        let mut interval = tokio::time::interval(self.settings.deployment.poll_interval());
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
