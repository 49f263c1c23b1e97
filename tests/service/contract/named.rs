//! Failures between files and record, and between record and event: at calls of a name, not by
//! chance, over both places for records and files.

use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{Command, JobId, Reason, State, StoreError, SubmitError, Submitted};

use super::faulty::{Fault, How};
use super::place::{Place, Servers};
use super::processes::Process;
use crate::harness::postgres::Postgres;
use crate::harness::s3::S3;

type Promise = fn(&Place);

/// All promises, by their names.
const PROMISES: [(&str, Promise); 12] = [
    ("a file of a submission is refused", |place| {
        a_refused_submission_leaves_nothing(place, "put", 1);
    }),
    ("the record of a submission is refused", |place| {
        a_refused_submission_leaves_nothing(place, "enqueue", 0);
    }),
    ("an unanswered record", an_unanswered_submission_is_kept),
    ("death before the record", death_before_the_record),
    ("death after the record", death_after_the_record),
    ("an output is refused", a_refused_output_is_made_again),
    ("the end is refused", a_refused_end_is_recorded_later),
    ("the end is unanswered", an_unanswered_end_is_recorded_once),
    (
        "death among outputs and before the end",
        death_before_the_end,
    ),
    ("death between the end and its event", death_after_the_end),
    ("no event of the end", an_end_is_seen_that_nobody_tells),
    (
        "death between record and files that go",
        death_before_files_go,
    ),
];

#[test]
fn sqlite_and_a_folder_keep_all_promises() {
    for (name, promise) in PROMISES {
        println!("{name}");
        promise(&Place::alone());
    }
}

#[test]
fn postgres_and_s3_keep_all_promises() {
    let servers = Servers {
        postgres: Postgres::start(),
        s3: S3::start(),
    };
    for (part, (name, promise)) in PROMISES.into_iter().enumerate() {
        println!("{name}");
        promise(&Place::shared(&servers, part));
    }
}

fn a_refused_submission_leaves_nothing(place: &Place, name: &'static str, skipped: usize) {
    let process = place.start(0, &Fault::of(name, How::Refused, skipped, 1));
    let refused = process.submit().expect_err("it is refused");
    assert!(matches!(refused, SubmitError::Store(error) if error.is_passing()));
    assert_eq!((process.all(), process.owners()), (vec![], vec![]));
    process.accepted();
}

/// The record is there, and who asks again gets it, with its files.
fn an_unanswered_submission_is_kept(place: &Place) {
    let process = place.start(1, &Fault::first("enqueue", How::Unanswered));
    let error = process.submit().expect_err("nobody answers");
    assert!(matches!(
        error,
        SubmitError::Store(StoreError::Unanswered(_))
    ));
    let Submitted::Replay(job) = process.submit().expect("an answer") else {
        panic!("it is recorded")
    };
    assert_eq!(process.succeeded(job.id).attempt, 1);
    assert_eq!(
        (process.all(), process.owners()),
        (vec![job.id], vec![job.id])
    );
}

fn death_before_the_record(place: &Place) {
    let fault = Fault::first("enqueue", How::Before);
    place.start(0, &fault).die_submitting(&fault);
    let process = place.start(1, &Fault::none());
    assert_eq!(process.all(), []);
    // Files without a job are kept in quarantine.
    assert_eq!(process.owners().len(), 1);
    let id = process.accepted();
    process.succeeded(id);
}

fn death_after_the_record(place: &Place) {
    let fault = Fault::first("enqueue", How::After);
    place.start(0, &fault).die_submitting(&fault);
    let process = place.start(1, &Fault::none());
    let Submitted::Replay(job) = process.submit().expect("an answer") else {
        panic!("it is recorded")
    };
    assert_eq!(process.succeeded(job.id).attempt, 1);
    assert_eq!(process.owners(), [job.id]);
}

fn a_refused_output_is_made_again(place: &Place) {
    // Two files come in, and one goes out before.
    let fault = Fault::of("put", How::Refused, 3, 1);
    let process = place.start(1, &fault);
    let id = process.accepted();
    let job = process.succeeded(id);
    assert!(fault.has_happened());
    assert_eq!((job.attempt, job.lost), (2, 0));
    removed(&process, id);
}

fn a_refused_end_is_recorded_later(place: &Place) {
    let fault = Fault::of("change", How::Refused, 0, 2);
    let process = place.start(1, &fault);
    let id = process.accepted();
    let job = process.succeeded(id);
    assert!(fault.has_happened());
    assert_eq!((job.attempt, job.lost), (1, 0));
}

fn an_unanswered_end_is_recorded_once(place: &Place) {
    let fault = Fault::first("change", How::Unanswered);
    let process = place.start(1, &fault);
    let id = process.accepted();
    let job = process.succeeded(id);
    assert!(fault.has_happened());
    assert_eq!((job.attempt, job.lost), (1, 0));
    // Its worker has told the end again when its next job has ended.
    removed(&process, id);
    let next = process.accepted();
    process.succeeded(next);
}

/// What the dead left is not mixed with what the next attempt makes.
fn death_before_the_end(place: &Place) {
    for fault in [
        Fault::of("put", How::After, 3, 1),
        Fault::first("change", How::Before),
    ] {
        let dying = place.start(1, &fault);
        let id = dying.accepted();
        dying.die_at(&fault);
        let process = place.start(1, &Fault::none());
        let job = process.succeeded(id);
        assert_eq!((job.attempt, job.lost, job.interrupted), (2, 0, 1));
        removed(&process, id);
    }
}

fn death_after_the_end(place: &Place) {
    let fault = Fault::first("change", How::After);
    // Who watches elsewhere sees the end in the record.
    let watcher = place.is_shared().then(|| place.start(0, &Fault::none()));
    let dying = place.start(1, &fault);
    let id = dying.accepted();
    let Some(watcher) = watcher else {
        dying.die_at(&fault);
        assert_eq!(place.start(1, &Fault::none()).succeeded(id).attempt, 1);
        return;
    };
    let job = std::thread::scope(|scope| {
        let watched = scope.spawn(|| watcher.succeeded(id));
        dying.die_at(&fault);
        watched.join().expect("it is seen")
    });
    let process = place.start(1, &Fault::none());
    let again = process.succeeded(id);
    assert_eq!(format!("{again:?}"), format!("{job:?}"));
    assert_eq!((job.attempt, job.lost), (1, 0));
}

/// The worker that recorded it never comes to tell it.
fn an_end_is_seen_that_nobody_tells(place: &Place) {
    let process = place.start(1, &Fault::first("change", How::After));
    let id = process.accepted();
    let job = process.succeeded(id);
    assert_eq!((job.attempt, job.lost), (1, 0));
}

/// Removes a job; nothing is left of it.
fn removed(process: &Process, id: JobId) {
    let jobs = process.jobs();
    let removed = process.does(jobs.remove(&Visibility::All, id, Reason::Deleted));
    assert!(removed.expect("an answer"));
    assert_eq!((process.all(), process.owners()), (vec![], vec![]));
}

fn death_before_files_go(place: &Place) {
    // A job that waits is cancelled, and one that has ended is removed.
    let cancelled = Fault::first("change", How::After);
    let dying = place.start(0, &cancelled);
    let (id, jobs) = (dying.accepted(), dying.jobs());
    let cancel = async move { jobs.command(&Visibility::All, id, Command::Cancel).await };
    dying.die_doing(cancel, &cancelled);
    let removed = Fault::first("delete", How::After);
    let dying = place.start(0, &removed);
    assert_eq!(dying.ended(id).state, State::Cancelled);
    assert_eq!(dying.owners().len(), usize::from(place.is_shared()));
    let jobs = dying.jobs();
    let remove = async move { jobs.remove(&Visibility::All, id, Reason::Deleted).await };
    dying.die_doing(remove, &removed);
    let process = place.start(0, &Fault::none());
    assert_eq!(process.all(), []);
    assert_eq!(process.owners().len(), usize::from(place.is_shared()));
}
