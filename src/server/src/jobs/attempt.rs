//! One attempt at a job, from the worker's side.

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tokio::time::Instant;
use tokio_util::sync::CancellationToken;
use tracing::Instrument;

use super::cgroup::Kills;
use super::child::{Child, Exit};
use super::conclusion::{conclude, disown};
use super::job::Job;
use super::keys::{input_key, output_key};
use super::memory_failure::{killed_for_memory, out_of_memory};
use super::queue::Jobs;
use super::running::Attempt;
use super::store_error::{StoreError, StoreResult};
use super::supervision::{Watched, watch};
use super::transition::Ending;
use unwrapd_api::{
    ERROR, Failure, Limits, NO_SPACE, OUTCOME, Outcome, Pictures, TASK, Task, input_file,
    output_file, read_json, write_json,
};

/// Delay before a retry of a job that could not run because space or files were unavailable.
const PAUSE: Duration = Duration::from_secs(1);
/// Delay before a job that needs a newer program is offered again.
const PAUSE_FOR_NEWER: Duration = Duration::from_secs(3);

/// Runs a claimed job with [`run`], with its id in every log line.
pub(super) async fn run_logged(
    jobs: &Jobs,
    job: Job,
    attempt: &Attempt,
    leave: &CancellationToken,
) -> Duration {
    let trace = job.trace.as_deref();
    let span = tracing::info_span!("attempt", job = %job.id, trace);
    run(jobs, job, attempt, leave).instrument(span).await
}

/// Runs a claimed job to its end and records the outcome. `leave` asks to hand the job back. Returns the time for
/// which this worker should pause: if files or space are unavailable, its next job would fare no better, but another
/// worker may succeed.
async fn run(jobs: &Jobs, job: Job, attempt: &Attempt, leave: &CancellationToken) -> Duration {
    let name = format!("attempt-{}-{}", job.id, job.token);
    let folder = jobs.settings.scratch.join(name);
    tracing::info!(job = %job.id, attempt = job.attempt, worker = %jobs.worker, "started");
    jobs.live.publish(job.id, job.event());
    let mut rest = Duration::ZERO;
    let ending = async {
        // They were checked when the job was accepted: by a newer program, during an update.
        let catalog = jobs.settings.catalog;
        if let Err(refused) = catalog.complete(job.kind, job.options.clone()) {
            let error = refused.failure.detail;
            tracing::warn!(job = %job.id, %error, "left to a newer program");
            return Ok(Some(Ending::HandedBack(PAUSE_FOR_NEWER)));
        }
        prepare(jobs, &job, &folder).await?;
        compute(jobs, &job, attempt, &folder, leave).await
    };
    let ending = ending.await.unwrap_or_else(|error| {
        tracing::error!(job = %job.id, %error, "attempt failed");
        Some(match error {
            StoreError::Damaged(what) => Ending::Failed(Failure::new("damaged_file", what)),
            StoreError::Missing(what) => Ending::Failed(Failure::new("missing_file", what)),
            _ if error.is_passing() => {
                rest = PAUSE;
                Ending::HandedBack(PAUSE)
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
    let made = tokio::fs::create_dir_all(folder).await;
    made.map_err(StoreError::at(folder))?;
    for (index, file) in job.input.iter().enumerate() {
        let to = folder.join(input_file(index));
        let key = input_key(job.id, index);
        jobs.fetch_verified(&key, file.sha256.as_deref(), &to)
            .await?;
    }
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
    attempt: &Attempt,
    folder: &Path,
    leave: &CancellationToken,
) -> StoreResult<Option<Ending>> {
    // Start the child and follow it until it ends or has to be ended.
    let kills = Kills::so_far();
    let mut child = Child::start(&jobs.settings.program, "compute", folder)?;
    let watched = watch(jobs, job, attempt, (&mut child, folder), leave).await;
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
    let said = read_json::<Failure>(folder, ERROR).ok();
    let failure = said.unwrap_or_else(|| exit.cause());
    Ok(Some(Ending::Failed(if failure.code == "out_of_memory" {
        out_of_memory(jobs.settings.memory)
    } else {
        failure
    })))
}

/// Registers an attempt at a job that was just claimed. Its lease counts from `sent`, before the claim was sent.
pub(super) fn started(jobs: &Jobs, job: &Job, sent: Instant) -> Arc<Attempt> {
    jobs.running.start(job, sent + jobs.settings.rules.lease)
}
