//! Supervision of a compute child: passes on its progress and ends it when needed.

use std::path::Path;
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::child::Child;
use super::deadline::{given_up_after, timed_out};
use super::job::Job;
use super::memory_failure::out_of_memory;
use super::meters::StageClock;
use super::progress::Event;
use super::queue::Jobs;
use super::running::Attempt;
use super::settings::Deployment;
use super::transition::Ending;
use unwrapd_api::Message;

/// Interval at which memory, processor time and lease are checked.
const WATCH_INTERVAL: Duration = Duration::from_millis(250);

/// Reason why supervision ended.
pub(super) enum Watched {
    /// The child's output ended.
    Silent,
    /// The child has to be ended.
    EndedBy(Ending),
    /// The job belongs to another worker.
    Outdated,
}

/// Passes on progress from a child and commands to it, until it ends or has to be ended.
pub(super) async fn watch(
    jobs: &Jobs,
    job: &Job,
    attempt: &Attempt,
    (child, folder): (&mut Child, &Path),
    leave: &CancellationToken,
) -> Watched {
    let limits = &jobs.settings;
    let deadline = Instant::now() + given_up_after(limits.time);
    let mut interval = tokio::time::interval(WATCH_INTERVAL);
    interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut event = attempt.event();
    let mut stages = StageClock::of(job.kind);
    let (mut is_ready, mut is_told, mut is_asked) = (false, false, false);
    loop {
        tokio::select! {
            message = child.next_message() => match message {
                None => return Watched::Silent,
                Some(Message::Ready) => is_ready = true,
                Some(Message::Cpu(ms)) => attempt.set_cpu_ms(ms),
                Some(Message::Progress(progress)) => {
                    event.progress.advance(progress);
                    stages.show(progress.stage);
                    event = Event { seq: event.seq + 1, ..job_event(job, event) };
                    attempt.set_event(event);
                    jobs.live.publish(job.id, event);
                }
                Some(Message::Maps) => {
                    attempt.maps.take(folder).await;
                    is_asked = false;
                }
            },
            // Reasons to end the child.
            () = attempt.outdated.cancelled() => return Watched::Outdated,
            () = attempt.cancel.cancelled() => return Watched::EndedBy(Ending::Cancelled),
            () = leave.cancelled() => {
                return Watched::EndedBy(Ending::HandedBack(Duration::ZERO));
            }
            () = tokio::time::sleep_until(deadline) => {
                return Watched::EndedBy(Ending::Failed(timed_out(limits.time)));
            }
            // Commands, which the child understands once it is ready.
            () = attempt.finish.cancelled(), if is_ready && !is_told => {
                child.interrupt();
                is_told = true;
            }
            () = attempt.maps.asked.notified(), if is_ready && !is_asked => {
                child.ask_for_maps().await;
                is_asked = true;
            }
            // Limits that only polling reveals.
            _ = interval.tick() => {
                attempt.set_cpu_ms(child.cpu_ms());
                if attempt.has_lapsed() {
                    return lapsed(jobs);
                }
                if limits.memory < child.resident_bytes() {
                    return Watched::EndedBy(Ending::Failed(out_of_memory(limits.memory)));
                }
            }
        }
    }
}

/// Decides on an attempt whose lease is over. With shared records, either this worker was silent and the job has gone
/// to another one, or the store was unreachable: handing the job back tells which. An embedded process always reaches
/// its store, so it was silent.
fn lapsed(jobs: &Jobs) -> Watched {
    match jobs.settings.deployment {
        Deployment::Embedded => Watched::Outdated,
        Deployment::Shared => Watched::EndedBy(Ending::HandedBack(Duration::ZERO)),
    }
}

/// Returns the event with the time since the attempt started.
fn job_event(job: &Job, event: Event) -> Event {
    Event {
        elapsed_ms: job.event().elapsed_ms,
        ..event
    }
}
