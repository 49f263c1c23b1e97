//! The table of all that can happen in every state.

use std::time::Duration;

use unwrapd::jobs::{
    Command, Ending, Job, Metadata, Refusal, State, Timestamp, Transition, WorkerId, after,
};
use unwrapd_api::{Failure, OutputFile, Verdict};

use super::{RULES, job, report};

const NOW: Timestamp = Timestamp(1_000_000);
const TOKEN: u64 = 5;

/// A job in a state, held or last held under [`TOKEN`].
fn in_state(state: State) -> Job {
    let is_running = state == State::Running;
    Job {
        state,
        token: TOKEN,
        attempt: 2,
        lost: 1,
        seq: 2_000_010,
        started: Some(Timestamp(900_000)),
        worker: is_running.then(WorkerId::fresh),
        lease: is_running.then(|| NOW.later(RULES.lease / 2)),
        finished: state.is_final().then_some(Timestamp(950_000)),
        failure: (state == State::Failed).then(|| Failure::new("crashed", "it did")),
        ..job()
    }
}

fn output() -> Vec<OutputFile> {
    vec![OutputFile {
        role: "result".to_owned(),
        name: "mesh.glb".to_owned(),
        bytes: 7,
        sha256: None,
    }]
}

/// Everything that can happen, by the token of the holder and by that of a former one.
fn transitions() -> Vec<(&'static str, Transition)> {
    let said = report(2_000_020, 0.5);
    let endings = [
        ("succeeded", Ending::Succeeded(output(), Verdict::default())),
        ("failed", Ending::Failed(Failure::new("no_uvs", "none"))),
        ("cancelled", Ending::Cancelled),
        ("lost", Ending::Lost(Failure::new("worker_lost", "gone"))),
        (
            "interrupted",
            Ending::Interrupted(Failure::new("worker_lost", "told")),
        ),
        ("handed back", Ending::Requeued(Duration::ZERO)),
    ];
    let mut all = vec![
        ("claim", Transition::Claimed(WorkerId::fresh())),
        ("beat", Transition::Heartbeat(TOKEN, said)),
        ("old beat", Transition::Heartbeat(TOKEN - 1, said)),
        ("sweep", Transition::Swept),
        ("abandon", Transition::Abandoned),
        ("cancel", Transition::Commanded(Command::Cancel)),
        ("finish", Transition::Commanded(Command::FinishEarly)),
        ("retry", Transition::Commanded(Command::Retry)),
        ("note", Transition::Noted(Metadata::default())),
    ];
    for (name, ending) in endings {
        all.push((name, Transition::Ended(TOKEN, said, ending.clone())));
        all.push(("old end", Transition::Ended(TOKEN - 1, said, ending)));
    }
    all
}

/// The state afterward, or why nothing happens.
#[allow(
    clippy::match_same_arms,
    reason = "a line for each transition reads like a table"
)]
fn expected(name: &str, state: State) -> Result<State, Refusal> {
    use Refusal::{Outdated, TooEarly, WrongState};
    use State::{Cancelled, Failed, Queued, Running, Succeeded};
    match (name, state) {
        ("old beat" | "old end", _) => Err(Outdated),
        ("claim", Queued) => Ok(Running),
        ("beat", Running) => Ok(Running),
        ("sweep", Running) => Err(TooEarly),
        ("abandon", Running) => Ok(Queued),
        ("cancel", Queued) => Ok(Cancelled),
        ("cancel", Running) => Ok(Running),
        ("finish", Queued | Running) => Ok(state),
        ("retry", Failed) => Ok(Queued),
        ("note", _) => Ok(state),
        ("succeeded", Running) => Ok(Succeeded),
        ("failed", Running) => Ok(Failed),
        ("cancelled", Running) => Ok(Cancelled),
        ("lost" | "interrupted" | "handed back", Running) => Ok(Queued),
        // Who did not hear the answer says it again.
        ("succeeded" | "failed" | "cancelled" | "lost" | "interrupted" | "handed back", _)
            if state.is_final() =>
        {
            Ok(state)
        }
        _ => Err(WrongState),
    }
}

#[test]
fn everything_happens_as_the_table_says() {
    for state in State::ALL {
        for (name, transition) in transitions() {
            let before = in_state(state);
            let became = after(&before, &transition, &RULES, NOW);
            let got = became.as_ref().map(|job| job.state).map_err(|r| *r);
            assert_eq!(got, expected(name, state), "{name} of {state:?}");
            let Ok(became) = became else { continue };
            assert!(before.token <= became.token && before.seq <= became.seq);
            assert!(before.lost <= became.lost || name == "retry");
            let is_held = became.state == State::Running;
            assert_eq!(became.worker.is_some(), is_held, "{name} of {state:?}");
            assert_eq!(became.lease.is_some(), is_held, "{name} of {state:?}");
            assert_eq!(became.finished.is_some(), became.state.is_final());
        }
    }
}

fn happen(job: &Job, transition: &Transition) -> Job {
    after(job, transition, &RULES, NOW).expect("it is allowed")
}

#[test]
fn the_token_rises_when_a_job_changes_hands() {
    let claimed = happen(
        &in_state(State::Queued),
        &Transition::Claimed(WorkerId::fresh()),
    );
    assert_eq!((claimed.token, claimed.attempt), (TOKEN + 1, 3));
    assert_eq!(claimed.seq, 3_000_000);
    let running = in_state(State::Running);
    assert_eq!(happen(&running, &Transition::Abandoned).token, TOKEN + 1);
    let silent = Job {
        lease: Some(Timestamp(NOW.0 - 1)),
        ..running.clone()
    };
    assert_eq!(happen(&silent, &Transition::Swept).token, TOKEN + 1);
    let ended = Ending::Lost(Failure::new("worker_lost", "gone"));
    let ended = happen(&running, &Transition::Ended(TOKEN, report(0, 0.0), ended));
    assert_eq!(ended.token, TOKEN);
}

#[test]
fn lost_attempts_are_counted_and_end_with_their_cause() {
    let mut job = in_state(State::Running);
    job.lost = RULES.attempts - 2;
    let lost = Ending::Lost(Failure::new("worker_lost", "killed"));
    let once = happen(&job, &Transition::Ended(TOKEN, report(0, 0.0), lost));
    assert_eq!((once.state, once.lost), (State::Queued, 2));
    assert_eq!(once.due, NOW.later(RULES.pause * 2));
    job.lost = RULES.attempts - 1;
    let cause = Ending::Lost(Failure::new("out_of_memory", "killed"));
    let parked = happen(&job, &Transition::Ended(TOKEN, report(0, 0.0), cause));
    assert_eq!(parked.state, State::Failed);
    let failure = parked.failure.as_ref().expect("a cause");
    assert_eq!(failure.code, "out_of_memory");
    assert_eq!(failure.detail, "killed; attempts lost: 3");
    let retried = happen(&parked, &Transition::Commanded(Command::Retry));
    assert_eq!((retried.lost, retried.failure), (0, None));
    let back = Ending::Requeued(Duration::ZERO);
    let back = happen(&job, &Transition::Ended(TOKEN, report(0, 0.0), back));
    assert_eq!(back.lost, job.lost);
}

/// A job is not to blame for the end of its worker, but one that ends every worker ends, too.
#[test]
fn attempts_lost_with_their_workers_count_apart() {
    let mut job = in_state(State::Running);
    job.lost = RULES.attempts - 1;
    let told = Ending::Interrupted(Failure::new("worker_lost", "SIGTERM"));
    let told = Transition::Ended(TOKEN, report(0, 0.0), told);
    for transition in [Transition::Abandoned, told] {
        let once = happen(&job, &transition);
        assert_eq!(
            (once.state, once.lost, once.interrupted),
            (State::Queued, job.lost, 1)
        );
        assert_eq!(once.due, NOW.later(RULES.pause));
    }
    job.interrupted = RULES.interruptions - 1;
    let parked = happen(&job, &Transition::Abandoned);
    assert_eq!(parked.state, State::Failed);
    assert_eq!(
        parked.failure.as_ref().expect("a cause").code,
        "worker_lost"
    );
    let retried = happen(&parked, &Transition::Commanded(Command::Retry));
    assert_eq!((retried.lost, retried.interrupted), (0, 0));
}

#[test]
fn who_wished_the_end_first_gets_it() {
    let job = happen(
        &in_state(State::Running),
        &Transition::Commanded(Command::Cancel),
    );
    let done = Ending::Succeeded(output(), Verdict::default());
    let lost = Ending::Lost(Failure::new("worker_lost", "gone"));
    let back = Ending::Requeued(Duration::ZERO);
    for ending in [done, lost, back] {
        let ended = happen(&job, &Transition::Ended(TOKEN, report(0, 0.0), ending));
        assert_eq!((ended.state, ended.output), (State::Cancelled, Vec::new()));
    }
    assert_eq!(happen(&job, &Transition::Abandoned).state, State::Cancelled);
}

#[test]
fn a_clock_that_was_set_back_holds_nothing_up() {
    let far = NOW.later(Duration::from_hours(1));
    let waiting = Job {
        due: far,
        ..in_state(State::Queued)
    };
    happen(&waiting, &Transition::Claimed(WorkerId::fresh()));
    let held = Job {
        lease: Some(far),
        ..in_state(State::Running)
    };
    let swept = happen(&held, &Transition::Swept);
    assert_eq!(swept.state, State::Running);
    assert_eq!(swept.lease, Some(NOW.later(RULES.lease)));
    let soon = Job {
        due: NOW.later(RULES.pause),
        ..in_state(State::Queued)
    };
    let early = Transition::Claimed(WorkerId::fresh());
    assert_eq!(
        after(&soon, &early, &RULES, NOW).expect_err("it waits"),
        Refusal::TooEarly
    );
}
