//! The end of an attempt: recorded, or disowned.

use std::time::Duration;

use tokio_util::sync::CancellationToken;

use super::access::Reach;
use super::job::Job;
use super::keys::output_folder;
use super::queue::Jobs;
use super::running::Attempt;
use super::storage::Changed;
use super::transition::{Ending, Happening};

/// Delay between two tries to record an end.
const PAUSE: Duration = Duration::from_secs(1);

/// Records how an attempt ended, and retries until the store answers: an outage of the store must not discard the
/// result. If the job has gone to another worker meanwhile, the store rejects the outcome. A worker that has to leave
/// does not wait: another one takes the job when the lease expires.
pub(super) async fn conclude(
    jobs: &Jobs,
    job: &Job,
    attempt: &Attempt,
    ending: Ending,
    leave: &CancellationToken,
) {
    let happening = Happening::Ended(attempt.token, attempt.saying(), ending);
    loop {
        match jobs.store.change(&Reach::All, job.id, &happening).await {
            Ok(Changed::Yes(job)) => {
                let failure = job.failure.as_ref();
                let code = failure.map(|failure| failure.code.as_str());
                tracing::info!(job = %job.id, state = job.state.word(), code, "ended");
                return jobs.tell(&job).await;
            }
            Ok(Changed::No(..) | Changed::Missing) => return disown(jobs, job).await,
            Err(error) if error.is_passing() => {
                tracing::warn!(job = %job.id, %error, "end not recorded yet");
                tokio::select! {
                    () = tokio::time::sleep(PAUSE) => {}
                    () = leave.cancelled() => return,
                }
            }
            Err(error) => {
                tracing::error!(job = %job.id, %error, "end not recorded");
                return;
            }
        }
    }
}

/// Removes the files of an outdated attempt.
pub(super) async fn disown(jobs: &Jobs, job: &Job) {
    tracing::warn!(job = %job.id, attempt = job.attempt, "outdated attempt");
    let folder = output_folder(job.id, job.token);
    if let Err(error) = jobs.blobs.remove(&folder).await {
        tracing::warn!(job = %job.id, %error, "files of an outdated attempt not removed");
    }
}
