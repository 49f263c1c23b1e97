//! One attempt at one job, seen from the server.

use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::time::{Instant, MissedTickBehavior};
use tokio_util::sync::CancellationToken;

use super::child::{Child, Exit};
use super::control::Control;
use super::job::{Failure, Job};
use super::keys::{input_key, output_key};
use super::queue::Jobs;
use super::state::State;
use super::store_error::{StoreError, StoreResult};
use super::task::{self, ERROR, Message, NO_SPACE, OUTCOME, Outcome, Pictures, TASK, Task};
use super::timestamp::Timestamp;
use crate::pipeline::Limits;

/// How often the child's memory is looked at.
const WATCH_INTERVAL: Duration = Duration::from_millis(250);
/// How often its progress is recorded.
const RECORD_INTERVAL: Duration = Duration::from_secs(1);
/// The share of its time after which a job is asked to finish with the map it has, rather than be ended without one.
const BUDGET_SHARE: f64 = 0.8;

/// How an attempt ended.
enum Ending {
    Succeeded(Outcome),
    Failed(Failure),
    Cancelled,
    /// The server stops, or has no space for it; the job shall run again.
    Waits,
}

/// Runs a claimed job to its end and records it.
pub(super) async fn run(jobs: &Jobs, mut job: Job, control: &Control, stop: &CancellationToken) {
    let folder = jobs
        .settings
        .scratch
        .join(format!("attempt-{}-{}", job.id, job.attempt));
    tracing::info!(job = %job.id, attempt = job.attempt, "started");
    jobs.events.publish(job.id, job.event());
    let ending = match prepare(jobs, &job, &folder).await {
        Ok(()) => compute(jobs, &mut job, &folder, control, stop).await,
        Err(error) => Err(error),
    };
    let ending = ending.unwrap_or_else(|error| {
        tracing::error!(job = %job.id, %error, "attempt failed");
        if error.is_passing() {
            return Ending::Waits;
        }
        Ending::Failed(Failure::new(
            "internal_error",
            "the server could not run it",
        ))
    });
    conclude(jobs, job, ending).await;
    if let Err(error) = tokio::fs::remove_dir_all(&folder).await {
        tracing::warn!(%error, "folder of an attempt not removed");
    }
}

async fn prepare(jobs: &Jobs, job: &Job, folder: &Path) -> StoreResult<()> {
    tokio::fs::create_dir_all(folder).await?;
    for index in 0..job.input.len() {
        let to = folder.join(task::input_file(index));
        jobs.blobs.fetch(&input_key(job.id, index), &to).await?;
    }
    let settings = &jobs.settings;
    let task = Task {
        kind: job.kind,
        input: job.input.iter().map(|file| file.name.clone()).collect(),
        options: job.options.clone(),
        limits: Limits {
            triangles: Some(settings.triangles),
            threads: Some(settings.threads),
            seconds: Some(settings.time.as_secs_f64() * BUDGET_SHARE),
        },
        memory: settings.memory,
        pictures: Pictures::Drawn,
    };
    Ok(task::write_json(folder, TASK, &task)?)
}

async fn compute(
    jobs: &Jobs,
    job: &mut Job,
    folder: &Path,
    control: &Control,
    stop: &CancellationToken,
) -> StoreResult<Ending> {
    let mut child = Child::start(&jobs.settings.program, folder)?;
    let ended_by_us = watch(jobs, job, &mut child, control, stop).await;
    if let Some(ending) = ended_by_us {
        child.terminate().await?;
        return Ok(ending);
    }
    let exit = child.wait().await?;
    if matches!(exit, Exit::Code(0)) {
        let outcome: Outcome = task::read_json(folder, OUTCOME)?;
        for index in 0..outcome.output.len() {
            let from: PathBuf = folder.join(task::output_file(index));
            jobs.blobs.put(&output_key(job.id, index), &from).await?;
        }
        return Ok(Ending::Succeeded(outcome));
    }
    if matches!(exit, Exit::Code(NO_SPACE)) {
        return Err(StoreError::Full("an attempt's folder".to_owned()));
    }
    let said = task::read_json::<Failure>(folder, ERROR).ok();
    Ok(Ending::Failed(said.unwrap_or_else(|| exit.cause())))
}

/// Passes on progress and wishes until the child's output ends (`None`) or there is a reason to end it.
async fn watch(
    jobs: &Jobs,
    job: &mut Job,
    child: &mut Child,
    control: &Control,
    stop: &CancellationToken,
) -> Option<Ending> {
    let limits = &jobs.settings;
    let deadline = Instant::now() + limits.time;
    let mut interval = tokio::time::interval(WATCH_INTERVAL);
    interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
    // The disk may be slow: a wish must not wait for a record.
    let mut recording = jobs.tasks.spawn(async {});
    let mut recorded = (job.seq, Instant::now());
    if job.finish_early {
        control.finish.cancel();
    }
    let (mut is_ready, mut is_told) = (false, false);
    loop {
        tokio::select! {
            message = child.next_message() => match message? {
                Message::Ready => is_ready = true,
                Message::Progress(progress) => {
                    job.progress.advance(progress);
                    job.seq += 1;
                    jobs.events.publish(job.id, job.event());
                }
            },
            () = control.cancel.cancelled() => return Some(Ending::Cancelled),
            () = stop.cancelled() => return Some(Ending::Waits),
            () = tokio::time::sleep_until(deadline) => {
                let seconds = limits.time.as_secs_f64();
                let detail = format!("not finished within {seconds} s");
                return Some(Ending::Failed(Failure::new("timed_out", detail)));
            }
            () = control.finish.cancelled(), if is_ready && !is_told => {
                child.interrupt();
                is_told = true;
            }
            _ = interval.tick() => {
                if limits.memory < child.resident_bytes() {
                    return Some(Ending::Failed(out_of_memory(limits.memory)));
                }
                let is_due = recorded.0 < job.seq && RECORD_INTERVAL <= recorded.1.elapsed();
                if is_due && recording.is_finished() {
                    recorded = (job.seq, Instant::now());
                    let record = jobs.store.record_progress(job.id, job.attempt, job.event());
                    recording = jobs.tasks.spawn(async {
                        if let Err(error) = record.await {
                            tracing::warn!(%error, "progress not recorded");
                        }
                    });
                }
            }
        }
    }
}

/// What a job is told that needs more than its share.
pub(super) fn out_of_memory(limit: u64) -> Failure {
    let detail = format!(
        "needs more than {} MiB, the memory limit of a job",
        limit >> 20
    );
    Failure::new("out_of_memory", detail)
}

async fn conclude(jobs: &Jobs, mut job: Job, ending: Ending) {
    match ending {
        Ending::Succeeded(Outcome { output, verdict }) => {
            job.state = State::Succeeded;
            job.progress.stage = None;
            job.progress.fraction = 1.0;
            job.output = output;
            job.verdict = verdict;
        }
        Ending::Failed(failure) => {
            job.state = State::Failed;
            job.failure = Some(if failure.code == "out_of_memory" {
                out_of_memory(jobs.settings.memory)
            } else {
                failure
            });
        }
        Ending::Cancelled => job.state = State::Cancelled,
        Ending::Waits => job.state = State::Queued,
    }
    job.seq += 1;
    if job.state.is_final() {
        job.finished = Some(Timestamp::now());
    }
    let code = job.failure.as_ref().map(|failure| failure.code.as_str());
    tracing::info!(job = %job.id, state = job.state.word(), code, "ended");
    match jobs.store.update(&job).await {
        Ok(true) if job.state.is_final() => jobs.end(&job).await,
        Ok(true) => jobs.events.publish(job.id, job.event()),
        Ok(false) => tracing::warn!(job = %job.id, attempt = job.attempt, "outdated attempt"),
        Err(error) => tracing::error!(job = %job.id, %error, "end not recorded"),
    }
}
