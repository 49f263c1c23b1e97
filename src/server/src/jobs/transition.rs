//! State machine of job records: a pure function of record and event.
//!
//! Stores read a record, call [`after`] and write the result, in one transaction. Nothing else decides.

use std::time::Duration;

use super::handling::Metadata;
use super::job::{Job, ProgressReport, Rules, State, Token, WorkerId, next_attempt_seq};
use super::timestamp::Timestamp;
use unwrapd_api::{Failure, OutputFile, Progress, Verdict};

/// Event in the life of a job, which changes its record.
#[derive(Clone, Debug)]
pub enum Transition {
    /// A worker claims it.
    Claimed(WorkerId),
    /// Its worker sends a heartbeat with its progress.
    Heartbeat(Token, ProgressReport),
    /// A process checks whether its lease has expired.
    Swept,
    /// Its worker is known to be gone.
    Abandoned,
    /// A worker's attempt ended.
    Ended(Token, ProgressReport, Ending),
    /// A client sends a command.
    Commanded(Command),
    /// A client replaces its metadata.
    Noted(Metadata),
    /// A picture of its result was drawn and stored.
    Drawn(Token, OutputFile),
}

/// Command of a client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Stop, and keep nothing but the record.
    Cancel,
    /// Stop iterating and write the current map.
    FinishEarly,
    /// Retry a failed job.
    Retry,
}

/// Outcome of an attempt.
#[derive(Clone, Debug)]
pub enum Ending {
    /// It succeeded with these files.
    Succeeded(Vec<OutputFile>, Verdict),
    /// It failed and would fail again.
    Failed(Failure),
    /// It was cancelled.
    Cancelled,
    /// Its computation was killed while its worker lived, possibly because of the job. A retry may succeed.
    Lost(Failure),
    /// It was stopped from outside, as on shutdown, which says nothing about the job.
    Interrupted(Failure),
    /// The worker cannot go on, for a reason unrelated to the job. Any worker may take the job after this time.
    Requeued(Duration),
}

/// Reason why a record stays unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The token is not that of the current attempt.
    Outdated,
    /// The event is not possible in its state.
    WrongState,
    /// The time for the event has not come.
    TooEarly,
}

/// Returns the record after an event at time `now`, or why it stays unchanged. Reporting an end twice is not an
/// error.
pub fn after(
    job: &Job,
    transition: &Transition,
    rules: &Rules,
    now: Timestamp,
) -> Result<Job, Refusal> {
    let mut job = job.clone();
    match transition {
        Transition::Claimed(worker) => claimed(&mut job, *worker, rules, now)?,
        Transition::Heartbeat(token, report) => {
            check(&job, *token)?;
            advance(&mut job, report);
            job.lease = Some(now.later(rules.lease));
        }
        Transition::Swept => swept(&mut job, rules, now)?,
        Transition::Abandoned => {
            let gone = Failure::new("worker_lost", "its worker is gone");
            taken_away(&mut job, &gone, rules, now)?;
        }
        // The end was reported before, but the answer was lost.
        Transition::Ended(token, ..) if job.token == *token && job.state.is_final() => {}
        Transition::Ended(token, report, ending) => {
            check(&job, *token)?;
            advance(&mut job, report);
            ended(&mut job, ending, rules, now);
        }
        Transition::Commanded(command) => commanded(&mut job, *command, now)?,
        Transition::Noted(metadata) => job.metadata.clone_from(metadata),
        Transition::Drawn(token, file) => drawn(&mut job, *token, file)?,
    }
    Ok(job)
}

fn check(job: &Job, token: Token) -> Result<(), Refusal> {
    match job.state {
        _ if job.token != token => Err(Refusal::Outdated),
        State::Running => Ok(()),
        _ => Err(Refusal::WrongState),
    }
}

fn claimed(job: &mut Job, worker: WorkerId, rules: &Rules, now: Timestamp) -> Result<(), Refusal> {
    if job.state != State::Queued {
        return Err(Refusal::WrongState);
    }
    // A pause longer than the longest one means that the clock was set back since: ignore it.
    if now < job.due && job.due <= now.later(rules.longest_pause()) {
        return Err(Refusal::TooEarly);
    }
    job.state = State::Running;
    job.attempt += 1;
    job.token += 1;
    job.seq = next_attempt_seq(job.seq);
    job.worker = Some(worker);
    job.lease = Some(now.later(rules.lease));
    job.started = Some(now);
    Ok(())
}

fn swept(job: &mut Job, rules: &Rules, now: Timestamp) -> Result<(), Refusal> {
    let latest = now.later(rules.lease);
    match job.lease {
        _ if job.state != State::Running => Err(Refusal::WrongState),
        // A lease longer than any that is granted means that the clock was set back since: shorten it.
        Some(lease) if latest < lease => {
            job.lease = Some(latest);
            Ok(())
        }
        Some(lease) if now <= lease => Err(Refusal::TooEarly),
        _ => {
            let silent = Failure::new("worker_lost", "its worker gave no sign of life in time");
            taken_away(job, &silent, rules, now)
        }
    }
}

fn taken_away(
    job: &mut Job,
    cause: &Failure,
    rules: &Rules,
    now: Timestamp,
) -> Result<(), Refusal> {
    if job.state != State::Running {
        return Err(Refusal::WrongState);
    }
    job.token += 1;
    job.seq = next_attempt_seq(job.seq);
    interrupted(job, cause, rules, now);
    Ok(())
}

/// Counts an attempt whose computation was killed.
fn lost(job: &mut Job, cause: &Failure, rules: &Rules, now: Timestamp) {
    job.lost += 1;
    try_again(job, cause, job.lost, rules.attempts, rules, now);
}

/// Counts an attempt lost with its worker. These are counted apart from killed computations, because most of them are
/// not the job's fault.
fn interrupted(job: &mut Job, cause: &Failure, rules: &Rules, now: Timestamp) {
    job.interrupted += 1;
    try_again(job, cause, job.interrupted, rules.interruptions, rules, now);
}

/// Requeues a job after a pause, or fails it if `lost` has reached the limit `most`. Ends it if it is cancelled.
fn try_again(job: &mut Job, cause: &Failure, lost: u32, most: u32, rules: &Rules, now: Timestamp) {
    if job.cancel {
        end(job, State::Cancelled, now);
    } else if most <= lost {
        let detail = format!("{}; attempts lost: {lost}", cause.detail);
        job.failure = Some(Failure::new(&cause.code, detail));
        end(job, State::Failed, now);
    } else {
        queue(job, now.later(rules.pause_after(lost)));
    }
}

fn ended(job: &mut Job, ending: &Ending, rules: &Rules, now: Timestamp) {
    job.seq += 1;
    match ending {
        Ending::Lost(cause) => lost(job, cause, rules, now),
        Ending::Interrupted(cause) => interrupted(job, cause, rules, now),
        // A cancellation that came first was promised to its client.
        _ if job.cancel => end(job, State::Cancelled, now),
        Ending::Cancelled => end(job, State::Cancelled, now),
        Ending::Failed(failure) => {
            job.failure = Some(failure.clone());
            end(job, State::Failed, now);
        }
        Ending::Succeeded(output, verdict) => {
            job.output.clone_from(output);
            job.verdict = verdict.clone();
            job.progress.stage = None;
            job.progress.fraction = 1.0;
            end(job, State::Succeeded, now);
        }
        Ending::Requeued(pause) => queue(job, now.later((*pause).min(rules.longest_pause()))),
    }
}

fn commanded(job: &mut Job, command: Command, now: Timestamp) -> Result<(), Refusal> {
    match (command, job.state) {
        (Command::Cancel, State::Queued) => {
            job.seq += 1;
            job.cancel = true;
            end(job, State::Cancelled, now);
        }
        (Command::Cancel, State::Running) => job.cancel = true,
        (Command::FinishEarly, State::Queued | State::Running) => job.finish_early = true,
        (Command::Retry, State::Failed) => {
            job.seq = next_attempt_seq(job.seq);
            (job.lost, job.interrupted) = (0, 0);
            job.failure = None;
            job.finished = None;
            job.progress = Progress::default();
            queue(job, now);
        }
        _ => return Err(Refusal::WrongState),
    }
    Ok(())
}

/// Records a picture in place of an earlier one, which was lost or drawn at the same time.
fn drawn(job: &mut Job, token: Token, file: &OutputFile) -> Result<(), Refusal> {
    match job.state {
        _ if job.token != token => return Err(Refusal::Outdated),
        State::Succeeded => {}
        _ => return Err(Refusal::WrongState),
    }
    job.drawn.retain(|earlier| earlier.role != file.role);
    job.drawn.push(file.clone());
    Ok(())
}

fn advance(job: &mut Job, report: &ProgressReport) {
    if job.seq < report.seq {
        job.seq = report.seq;
        job.progress.advance(report.progress);
    }
}

fn queue(job: &mut Job, due: Timestamp) {
    job.state = State::Queued;
    job.due = due;
    (job.worker, job.lease) = (None, None);
}

fn end(job: &mut Job, state: State, now: Timestamp) {
    job.state = state;
    job.finished = Some(now);
    (job.worker, job.lease) = (None, None);
}
