//! Attempts started as jobs come.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

use super::attempt;
use super::job::Job;
use super::queue::Jobs;

/// Between two tries of a store that fails.
const STORE_RETRY: Duration = Duration::from_secs(1);

impl Jobs {
    /// Starts attempts as jobs come and slots are free. When told to stop, ends the running attempts, puts their jobs
    /// back in the queue and returns. Removes jobs whose time is over meanwhile.
    pub async fn run(self: Arc<Self>, stop: CancellationToken) {
        let (jobs, stopped) = (Arc::clone(&self), stop.clone());
        self.tasks
            .spawn(async move { jobs.remove_expired_until(&stopped).await });
        let slots = Arc::new(Semaphore::new(self.settings.concurrency));
        while let Some((slot, job)) = self.next(&slots, &stop).await {
            let (jobs, stop) = (Arc::clone(&self), stop.clone());
            self.tasks.spawn(async move {
                let control = jobs.control(job.id).unwrap_or_default();
                attempt::run(&jobs, job, &control, &stop).await;
                drop(slot);
            });
        }
        self.tasks.close();
        self.tasks.wait().await;
    }

    async fn next(
        &self,
        slots: &Arc<Semaphore>,
        stop: &CancellationToken,
    ) -> Option<(tokio::sync::OwnedSemaphorePermit, Job)> {
        let slot = tokio::select! {
            slot = Arc::clone(slots).acquire_owned() => slot.ok()?,
            () = stop.cancelled() => return None,
        };
        while !stop.is_cancelled() {
            let claimed = match self.has_room() {
                Ok(()) => self.store.claim().await,
                Err(error) => Err(error),
            };
            match claimed {
                Ok(Some(job)) => return Some((slot, job)),
                Ok(None) => tokio::select! {
                    () = self.wake.notified() => {}
                    () = stop.cancelled() => return None,
                },
                Err(error) => {
                    tracing::error!(%error, "no job claimed");
                    tokio::select! {
                        () = tokio::time::sleep(STORE_RETRY) => {}
                        () = stop.cancelled() => return None,
                    }
                }
            }
        }
        None
    }
}
