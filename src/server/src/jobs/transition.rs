//! How the record of a job changes: a pure function of the record and of what happens.
//!
//! Stores read a record, call [`after`] and write the answer, in one transaction. Nothing else
//! decides.

use std::time::Duration;

use super::job::Job;
use super::lease::{Rules, Token, WorkerId};
use super::progress::{Saying, next_attempt_seq};
use super::state::State;
use super::timestamp::Timestamp;
use unwrapd_api::{Failure, OutputFile, Progress, Verdict};

/// What can happen to a job.
#[derive(Clone, Debug)]
pub enum Happening {
    /// A worker takes it.
    Claimed(WorkerId),
    /// The worker that has it is alive and says how far it is.
    Beat(Token, Saying),
    /// Somebody checks whether the worker has been silent for too long.
    Swept,
    /// The worker that had it is known to be gone.
    Abandoned,
    /// The attempt of a worker ended.
    Ended(Token, Saying, Ending),
    /// A client asks for something.
    Wished(Wish),
    /// A picture of what it made was drawn and stored.
    Drawn(Token, OutputFile),
}

/// What a client may ask of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Stop; nothing is kept but the record.
    Cancel,
    /// Stop iterating and write the map as it is.
    FinishEarly,
    /// Try again what failed.
    Retry,
}

/// How an attempt ended.
#[derive(Clone, Debug)]
pub enum Ending {
    /// With these files.
    Succeeded(Vec<OutputFile>, Verdict),
    /// By itself, and it would again.
    Failed(Failure),
    /// By request.
    Cancelled,
    /// Its computation was killed while its worker lived, which may be the fault of the job.
    /// Another attempt may succeed.
    Lost(Failure),
    /// It was told from outside to stop, as when a machine is shut down, which is no fault of the
    /// job.
    Interrupted(Failure),
    /// The worker cannot go on, for a reason that is not the job's. Any worker may, after this
    /// time.
    HandedBack(Duration),
}

/// Why a record stays as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The token is not that of the present attempt.
    Outdated,
    /// This cannot happen in its state.
    WrongState,
    /// Its time has not come.
    TooEarly,
}

/// The record after something happened at a time, or why it stays as it is. An end that is
/// reported twice is no fault.
pub fn after(
    job: &Job,
    happening: &Happening,
    rules: &Rules,
    now: Timestamp,
) -> Result<Job, Refusal> {
    let mut job = job.clone();
    match happening {
        Happening::Claimed(worker) => claimed(&mut job, *worker, rules, now)?,
        Happening::Beat(token, saying) => {
            check(&job, *token)?;
            advance(&mut job, saying);
            job.lease = Some(now.later(rules.lease));
        }
        Happening::Swept => swept(&mut job, rules, now)?,
        Happening::Abandoned => {
            let gone = Failure::new("worker_lost", "its worker is gone");
            taken_away(&mut job, &gone, rules, now)?;
        }
        Happening::Ended(token, ..) if job.token == *token && job.state.is_final() => {}
        Happening::Ended(token, saying, ending) => {
            check(&job, *token)?;
            advance(&mut job, saying);
            ended(&mut job, ending, rules, now);
        }
        Happening::Wished(wish) => wished(&mut job, *wish, now)?,
        Happening::Drawn(token, file) => drawn(&mut job, *token, file)?,
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
    // A pause longer than the longest: the clock was set back.
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
        // Longer than any that is given: the clock was set back.
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

/// Counts an attempt whose computation was killed. It is never given back.
fn lost(job: &mut Job, cause: &Failure, rules: &Rules, now: Timestamp) {
    job.lost += 1;
    try_again(job, cause, (job.lost, rules.attempts), rules, now);
}

/// Counts an attempt that was lost with its worker, apart from those that were killed: the job just
/// happened to be there, most likely.
fn interrupted(job: &mut Job, cause: &Failure, rules: &Rules, now: Timestamp) {
    job.interrupted += 1;
    try_again(
        job,
        cause,
        (job.interrupted, rules.interruptions),
        rules,
        now,
    );
}

/// Queues a job again after a pause, unless as many attempts are lost as may be.
fn try_again(
    job: &mut Job,
    cause: &Failure,
    (lost, most): (u32, u32),
    rules: &Rules,
    now: Timestamp,
) {
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
        // Whoever asked for that first has been promised it.
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
        Ending::HandedBack(pause) => queue(job, now.later((*pause).min(rules.longest_pause()))),
    }
}

fn wished(job: &mut Job, wish: Wish, now: Timestamp) -> Result<(), Refusal> {
    match (wish, job.state) {
        (Wish::Cancel, State::Queued) => {
            job.seq += 1;
            job.cancel = true;
            end(job, State::Cancelled, now);
        }
        (Wish::Cancel, State::Running) => job.cancel = true,
        (Wish::FinishEarly, State::Queued | State::Running) => job.finish_early = true,
        (Wish::Retry, State::Failed) => {
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

/// Notes a picture in the place of an earlier one, which was lost or drawn at the same time.
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

fn advance(job: &mut Job, saying: &Saying) {
    if job.seq < saying.seq {
        job.seq = saying.seq;
        job.progress.advance(saying.progress);
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
