//! Sweeping: jobs of silent workers go back to the queue.

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::meters;
use super::queue::Jobs;
use super::state::State;
use super::storage::Sweep;
use super::store_error::StoreResult;

/// Sweeps per lease. A job is taken from a silent worker after about 4/3 of a lease at most; more sweeps shorten the
/// delay but query the store more often.
const SWEEPS: u32 = 3;

impl Jobs {
    /// Sweeps periodically until stopped. Takes no job before the store has answered without delay for the time of a
    /// lease: workers that could not reach the store are not silent, and hand their jobs back themselves.
    pub(super) async fn sweep_until(&self, stop: &CancellationToken) {
        let lease = self.settings.rules.lease;
        let pause = lease / SWEEPS;
        let mut interval = tokio::time::interval(pause);
        interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut answers_since = Instant::now();
        loop {
            tokio::select! {
                _ = interval.tick() => {}
                () = stop.cancelled() => return,
            }
            // Ask the store a short question, and count the time since its last slow or missing answer.
            let asked = Instant::now();
            let mut answer = self.store.check().await;
            if asked.elapsed() > pause {
                answers_since = Instant::now();
            }
            // Sweep once workers have had the time of a lease to reach the store again.
            if answer.is_ok() && answers_since.elapsed() >= lease {
                answer = self.sweep(Sweep::Overdue).await;
            }
            if let Err(error) = answer {
                meters::store_failed();
                tracing::error!(%error, "jobs of silent workers not looked for");
                answers_since = Instant::now();
            }
        }
    }

    /// Takes jobs from their workers and notifies watchers.
    pub(super) async fn sweep(&self, sweep: Sweep) -> StoreResult<()> {
        for job in self.store.sweep(sweep).await? {
            if job.state != State::Running {
                meters::taken();
                let (state, interrupted) = (job.state.word(), job.interrupted);
                tracing::warn!(job = %job.id, state, interrupted, "taken from its worker");
            }
            self.tell(&job).await;
        }
        Ok(())
    }
}
