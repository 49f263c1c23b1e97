//! Metrics of jobs, their stages and errors.
//!
//! Names follow the conventions of Prometheus and do not change, because dashboards and alerts refer to them. Each
//! process counts its own actions; figures read from the store are the same in all.

use metrics::{
    Unit, counter, describe_counter, describe_gauge, describe_histogram, gauge, histogram,
};
use tokio::time::Instant;

use super::job::{Job, State};
use super::timestamp::Timestamp;
use unwrapd_api::{Kind, Stage};

const ENQUEUED: &str = "unwrapd_jobs_enqueued_total";
const FINISHED: &str = "unwrapd_jobs_finished_total";
const FAILURES: &str = "unwrapd_job_failures_total";
const TAKEN: &str = "unwrapd_jobs_taken_from_workers_total";
const STORE_ERRORS: &str = "unwrapd_store_errors_total";
const LOSSES: &str = "unwrapd_damaged_files_total";
const QUARANTINE_STOPPED: &str = "unwrapd_quarantine_stopped";
const WAIT: &str = "unwrapd_job_wait_seconds";
const RUN: &str = "unwrapd_job_run_seconds";
const STAGE: &str = "unwrapd_job_stage_seconds";

/// Results of jobs. A copy of an earlier result counts separately.
const RESULTS: [&str; 4] = ["succeeded", "failed", "cancelled", "reused"];

/// Describes the metrics and sets the counters to zero, so that their first increment is visible.
pub fn describe() {
    describe_counter!(ENQUEUED, "Jobs accepted by this process");
    describe_counter!(FINISHED, "Jobs whose end this process recorded");
    describe_counter!(FAILURES, "Failed jobs by the code of their problem");
    describe_counter!(TAKEN, "Jobs taken from silent workers");
    describe_counter!(STORE_ERRORS, "Calls of the store that failed");
    describe_counter!(LOSSES, "Stored files that were found missing or damaged");
    describe_gauge!(
        QUARANTINE_STOPPED,
        "Whether so many files have no job that none of them is deleted"
    );
    let seconds = Unit::Seconds;
    describe_histogram!(WAIT, seconds, "From acceptance to the latest start");
    describe_histogram!(RUN, seconds, "From the latest start to the end");
    describe_histogram!(STAGE, seconds, "Time in each stage of a computation");
    for kind in Kind::ALL.map(Kind::word) {
        counter!(ENQUEUED, "kind" => kind).absolute(0);
        for result in RESULTS {
            counter!(FINISHED, "kind" => kind, "result" => result).absolute(0);
        }
    }
    counter!(TAKEN).absolute(0);
    counter!(STORE_ERRORS).absolute(0);
    counter!(LOSSES).absolute(0);
    gauge!(QUARANTINE_STOPPED).set(0.0);
}

/// Counts an accepted job.
pub(super) fn enqueued(job: &Job) {
    counter!(ENQUEUED, "kind" => job.kind.word()).increment(1);
    finished(job);
}

/// Counts a job that has ended, and records its times; does nothing for one that has not.
pub(super) fn finished(job: &Job) {
    let Some(end) = job.finished.filter(|_| job.state.is_final()) else {
        return;
    };
    let kind = job.kind.word();
    let is_copy = job.is_copy();
    let result = if is_copy { "reused" } else { job.state.word() };
    counter!(FINISHED, "kind" => kind, "result" => result).increment(1);
    if let Some(failure) = job.failure.as_ref().filter(|_| job.state == State::Failed) {
        counter!(FAILURES, "code" => failure.code.clone()).increment(1);
    }
    if let Some(start) = job.started {
        histogram!(WAIT, "kind" => kind).record(seconds_since(job.created, start));
        histogram!(RUN, "kind" => kind, "result" => result).record(seconds_since(start, end));
    }
}

fn seconds_since(start: Timestamp, end: Timestamp) -> f64 {
    end.since(start) as f64 / 1000.0
}

/// Counts a job taken from a silent worker.
pub(super) fn taken() {
    counter!(TAKEN).increment(1);
}

/// Counts a failed call of the store.
pub fn store_failed() {
    counter!(STORE_ERRORS).increment(1);
}

/// Counts a stored file that is missing or damaged.
pub(super) fn file_lost() {
    counter!(LOSSES).increment(1);
}

/// Records whether deletion is suspended because too many files have no job.
pub(super) fn quarantine_stopped(is_stopped: bool) {
    gauge!(QUARANTINE_STOPPED).set(f64::from(u8::from(is_stopped)));
}

/// Times the stages of an attempt; dropping it ends the last stage.
pub(super) struct StageClock {
    kind: Kind,
    present: Option<(Stage, Instant)>,
}

impl StageClock {
    /// Creates a clock that is in no stage yet.
    pub fn of(kind: Kind) -> Self {
        Self {
            kind,
            present: None,
        }
    }

    /// Switches to the stage that an attempt is in.
    pub fn show(&mut self, stage: Option<Stage>) {
        if self.present.map(|(stage, _)| stage) != stage {
            self.end();
            self.present = stage.map(|stage| (stage, Instant::now()));
        }
    }

    fn end(&mut self) {
        if let Some((stage, since)) = self.present.take() {
            let (kind, seconds) = (self.kind.word(), since.elapsed().as_secs_f64());
            histogram!(STAGE, "kind" => kind, "stage" => stage.word()).record(seconds);
        }
    }
}

impl Drop for StageClock {
    fn drop(&mut self) {
        self.end();
    }
}
