//! One attempt at a job, from the worker's side.

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use super::access::Visibility;
use super::child::{
    Child, Exit, Kills, given_up_after, killed_for_memory, out_of_memory, timed_out,
};
use super::files::{input_key, output_folder, output_key};
use super::job::{Event, Job};
use super::meters::StageClock;
use super::queue::Jobs;
use super::running::RunningAttempt;
use super::settings::Deployment;
use super::storage::Changed;
use super::store_error::{StoreError, StoreResult};
use super::transition::{Ending, Transition};
use unwrapd_api::{
    ERROR, Failure, Limits, Message, NO_SPACE, OUTCOME, Outcome, Pictures, TASK, Task, input_file,
    output_file, read_json, write_json,
};

/// Delay before a retry of a job that could not run because space or files were unavailable. Longer delays leave the
/// worker idle after a short outage; shorter ones repeat an attempt that fails the same way.
const PAUSE: Duration = Duration::from_secs(1);
/// Delay before a job that needs a newer program is offered again. Longer delays make the job wait although a newer
/// worker has started; shorter ones make old workers claim it more often during an update.
const PAUSE_FOR_NEWER: Duration = Duration::from_secs(3);

/// Runs a claimed job with [`run`], with its id in every log line.
pub(super) async fn run_logged(
    jobs: &Jobs,
    job: Job,
    attempt: &RunningAttempt,
    leave: &CancellationToken,
) -> Duration {
    let trace = job.trace.as_deref();
    let span = tracing::info_span!("attempt", job = %job.id, trace);
    run(jobs, job, attempt, leave).instrument(span).await
}

/// Runs a claimed job to its end and records the outcome. `leave` asks to hand the job back. Returns the time for
/// which this worker should pause: without files or space its next job would fail as well, but another worker may
/// succeed.
async fn run(
    jobs: &Jobs,
    job: Job,
    attempt: &RunningAttempt,
    leave: &CancellationToken,
) -> Duration {
    // Announce the attempt.
    let name = format!("attempt-{}-{}", job.id, job.token);
    let folder = jobs.settings.scratch.join(name);
    tracing::info!(job = %job.id, attempt = job.attempt, worker = %jobs.worker, "started");
    jobs.live.publish(job.id, job.event());
    let mut rest = Duration::ZERO;
    // Prepare the folder and compute.
    let ending = async {
        // The options were checked when the job was accepted, but during an update by a newer program.
        let catalog = jobs.settings.catalog;
        if let Err(refused) = catalog.complete(job.kind, job.options.clone()) {
            let error = refused.failure.detail;
            tracing::warn!(job = %job.id, %error, "left to a newer program");
            return Ok(Some(Ending::Requeued(PAUSE_FOR_NEWER)));
        }
        prepare(jobs, &job, &folder).await?;
        compute(jobs, &job, attempt, &folder, leave).await
    };
    // Turn an error into an ending: temporary causes hand the job back, all others fail it.
    let ending = ending.await.unwrap_or_else(|error| {
        tracing::error!(job = %job.id, %error, "attempt failed");
        Some(match error {
            StoreError::Damaged(what) => Ending::Failed(Failure::new("damaged_file", what)),
            StoreError::Missing(what) => Ending::Failed(Failure::new("missing_file", what)),
            _ if error.is_passing() => {
                rest = PAUSE;
                Ending::Requeued(PAUSE)
            }
            StoreError::File { why, .. } => {
                let detail = format!("a file of the service cannot be used: {why}");
                Ending::Failed(Failure::new("internal_error", detail))
            }
            _ => Ending::Failed(Failure::new(
                "internal_error",
                "the service could not run it",
            )),
        })
    });
    // Record the ending, then forget the attempt and its folder.
    match ending {
        Some(ending) => conclude(jobs, &job, attempt, ending, leave).await,
        None => disown(jobs, &job).await,
    }
    jobs.running.end(job.id, job.token);
    match tokio::fs::remove_dir_all(&folder).await {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            tracing::warn!(%error, "folder of an attempt not removed");
        }
        _ => {}
    }
    rest
}

async fn prepare(jobs: &Jobs, job: &Job, folder: &Path) -> StoreResult<()> {
    // Fetch and verify the input.
    let made = tokio::fs::create_dir_all(folder).await;
    made.map_err(StoreError::at(folder))?;
    for (index, file) in job.input.iter().enumerate() {
        let to = folder.join(input_file(index));
        let key = input_key(job.id, index);
        jobs.fetch_verified(&key, file.sha256.as_deref(), &to)
            .await?;
    }
    // Write the task last: the child starts from it.
    let settings = &jobs.settings;
    let task = Task {
        kind: job.kind,
        input: job.input.iter().map(|file| file.name.clone()).collect(),
        options: job.options.clone(),
        limits: Limits {
            triangles: Some(settings.triangles),
            threads: Some(settings.threads(jobs.running.len())),
            seconds: Some(settings.time.as_secs_f64()),
        },
        memory: settings.memory,
        pictures: Pictures::OnRequest,
    };
    Ok(write_json(folder, TASK, &task)?)
}

/// Runs the compute child and returns how the attempt ended; `None` if the job belongs to another worker by now.
async fn compute(
    jobs: &Jobs,
    job: &Job,
    attempt: &RunningAttempt,
    folder: &Path,
    leave: &CancellationToken,
) -> StoreResult<Option<Ending>> {
    // Start the child and follow it until it ends or has to be ended.
    let kills = Kills::so_far();
    let mut child = Child::start(&jobs.settings.program, "compute", folder)?;
    let watched = watch(jobs, job, attempt, &mut child, folder, leave).await;
    if !matches!(watched, Watched::Silent) {
        child.terminate().await?;
    }
    match watched {
        Watched::EndedBy(ending) => return Ok(Some(ending)),
        Watched::Outdated => return Ok(None),
        Watched::Silent => {}
    }
    let exit = child.wait().await?;
    // Success: store the output files.
    if matches!(exit, Exit::Code(0)) {
        let mut outcome: Outcome = read_json(folder, OUTCOME)?;
        jobs.engine().await?.clone_into(&mut outcome.verdict.engine);
        for index in 0..outcome.output.len() {
            let key = output_key(job.id, attempt.token, index);
            let from = folder.join(output_file(index));
            jobs.blobs.put(&key, &from).await?;
        }
        return Ok(Some(Ending::Succeeded(outcome.output, outcome.verdict)));
    }
    // Any other exit: retry if the cause lies outside the job, otherwise fail.
    if matches!(exit, Exit::Code(NO_SPACE)) {
        return Err(StoreError::Full("an attempt's folder".to_owned()));
    }
    if exit.is_from_outside() && !exit.is_kill() {
        return Ok(Some(Ending::Interrupted(exit.cause())));
    }
    if exit.is_kill() {
        let is_out_of_memory = kills.is_one_more();
        let cause = if is_out_of_memory {
            killed_for_memory()
        } else {
            exit.cause()
        };
        return Ok(Some(Ending::Lost(cause)));
    }
    // The child reports a memory failure without knowing its limit.
    let said = read_json::<Failure>(folder, ERROR).ok();
    let failure = said.unwrap_or_else(|| exit.cause());
    Ok(Some(Ending::Failed(if failure.code == "out_of_memory" {
        out_of_memory(jobs.settings.memory)
    } else {
        failure
    })))
}

/// Registers an attempt at a job that was just claimed. Its lease counts from `sent`, before the claim was sent.
pub(super) fn started(jobs: &Jobs, job: &Job, sent: Instant) -> Arc<RunningAttempt> {
    jobs.running.start(job, sent + jobs.settings.rules.lease)
}

// The end of an attempt: recorded, or disowned.

/// Delay between two attempts to record an end. Longer delays keep the slot of a finished job occupied; shorter ones
/// burden a store that is recovering.
const RECORDING_PAUSE: Duration = Duration::from_secs(1);

/// Records how an attempt ended, and retries until the store answers: an outage of the store must not discard the
/// result. If the job has gone to another worker meanwhile, the store rejects the outcome. A worker that has to leave
/// does not wait: another one takes the job when the lease expires.
async fn conclude(
    jobs: &Jobs,
    job: &Job,
    attempt: &RunningAttempt,
    ending: Ending,
    leave: &CancellationToken,
) {
    let transition = Transition::Ended(attempt.token, attempt.report(), ending);
    loop {
        match jobs
            .store
            .change(&Visibility::All, job.id, &transition)
            .await
        {
            Ok(Changed::Yes(job)) => {
                let failure = job.failure.as_ref();
                let code = failure.map(|failure| failure.code.as_str());
                tracing::info!(job = %job.id, state = job.state.word(), code, "ended");
                return jobs.tell(&job).await;
            }
            // The job was deleted or taken by another worker: its result has no owner.
            Ok(Changed::No(..) | Changed::Missing) => return disown(jobs, job).await,
            Err(error) if error.is_passing() => {
                tracing::warn!(job = %job.id, %error, "end not recorded yet");
                tokio::select! {
                    () = tokio::time::sleep(RECORDING_PAUSE) => {}
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
async fn disown(jobs: &Jobs, job: &Job) {
    tracing::warn!(job = %job.id, attempt = job.attempt, "outdated attempt");
    let folder = output_folder(job.id, job.token);
    if let Err(error) = jobs.blobs.remove(&folder).await {
        tracing::warn!(job = %job.id, %error, "files of an outdated attempt not removed");
    }
}

// Supervision of a compute child: passes on its progress and ends it when needed.

/// Interval at which memory, processor time and lease are checked. A child can exceed its memory limit for this long;
/// each check reads two files of `/proc`.
const WATCH_INTERVAL: Duration = Duration::from_millis(250);

/// Reason why supervision ended.
enum Watched {
    /// The child's output ended.
    Silent,
    /// The child has to be ended.
    EndedBy(Ending),
    /// The job belongs to another worker.
    Outdated,
}

/// Passes on progress from a child and commands to it, until it ends or has to be ended.
async fn watch(
    jobs: &Jobs,
    job: &Job,
    attempt: &RunningAttempt,
    child: &mut Child,
    folder: &Path,
    leave: &CancellationToken,
) -> Watched {
    // Set up the deadline, the polling and the progress to report.
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
                return Watched::EndedBy(Ending::Requeued(Duration::ZERO));
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
        Deployment::Shared => Watched::EndedBy(Ending::Requeued(Duration::ZERO)),
    }
}

/// Returns the event with the time since the attempt started.
fn job_event(job: &Job, event: Event) -> Event {
    Event {
        elapsed_ms: job.event().elapsed_ms,
        ..event
    }
}
