//! How long a job stays with whom.

use std::sync::Arc;

use unwrapd::jobs::{
    Changed, Command, JobId, JobStore, Refusal, SUSPECT, Share, State, Sweep, Transition, WorkerId,
};
use unwrapd::store::RecordStore;

use super::{get, succeed, success, swept};
use crate::contract::{RULES, change, claim, claim_soon, claimed, enqueued, job, report, yes};

pub async fn a_beat_renews_the_lease_and_brings_wishes(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let first = job.lease.expect("a lease");
    for command in [Command::FinishEarly, Command::Cancel] {
        yes(change(&store, job.id, Transition::Commanded(command)).await);
    }
    let mut seq = job.seq;
    // Longer than a lease, and nobody takes the job.
    loop {
        seq += 1;
        let heartbeat = (job.id, job.token, report(seq, 0.25));
        let answers = store.heartbeat(&[heartbeat]).await.expect("an answer");
        let beaten = yes(answers[0].clone());
        assert!(beaten.cancel && beaten.finish_early);
        assert_eq!((beaten.seq, beaten.progress.fraction), (seq, 0.25));
        assert!(
            store
                .sweep(Sweep::Overdue)
                .await
                .expect("an answer")
                .is_empty()
        );
        if first.later(RULES.lease * 2) < beaten.lease.expect("a lease") {
            break;
        }
        tokio::time::sleep(RULES.lease / 8).await;
    }
}

pub async fn beats_are_answered_in_their_order(store: Arc<RecordStore>) {
    for _ in 0..3 {
        enqueued(&store, &job()).await;
    }
    let mut jobs = Vec::new();
    while let Some(job) = claim(&store).await {
        jobs.push(job);
    }
    jobs.reverse();
    succeed(&store, &jobs[1]).await;
    let mut heartbeats: Vec<_> = jobs
        .iter()
        .map(|job| (job.id, job.token, report(job.seq, 0.0)))
        .collect();
    heartbeats[2].1 += 1;
    heartbeats.push((JobId::fresh(), 1, report(1, 0.0)));
    let answers = store.heartbeat(&heartbeats).await.expect("an answer");
    assert_eq!(yes(answers[0].clone()).id, jobs[0].id);
    assert!(matches!(&answers[1], Changed::No(job, Refusal::WrongState) if job.id == jobs[1].id));
    assert!(matches!(&answers[2], Changed::No(job, Refusal::Outdated) if job.id == jobs[2].id));
    assert!(matches!(answers[3], Changed::Missing));
}

pub async fn a_silent_worker_loses_its_job(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    assert!(
        store
            .sweep(Sweep::Overdue)
            .await
            .expect("an answer")
            .is_empty()
    );
    let swept = swept(&store).await;
    assert_eq!((swept.len(), swept[0].id), (1, job.id));
    assert_eq!(
        (swept[0].state, swept[0].lost, swept[0].interrupted),
        (State::Queued, 0, 1)
    );
    assert_eq!(swept[0].token, job.token + 1);
    let again = claim_soon(&store).await;
    assert_eq!((again.attempt, again.token), (2, job.token + 2));
}

pub async fn a_former_holder_changes_nothing(store: Arc<RecordStore>) {
    let former = claimed(&store).await;
    swept(&store).await;
    // While the job waits, and while somebody else has it.
    for is_held in [false, true] {
        if is_held {
            claim_soon(&store).await;
        }
        let before = format!("{:?}", get(&store, former.id).await);
        let heartbeat = (former.id, former.token, report(former.seq + 5, 0.9));
        let answers = store.heartbeat(&[heartbeat]).await.expect("an answer");
        assert!(matches!(answers[0], Changed::No(_, Refusal::Outdated)));
        let end = Transition::Ended(former.token, heartbeat.2, success());
        let end = change(&store, former.id, end).await;
        assert!(matches!(end, Changed::No(_, Refusal::Outdated)));
        assert_eq!(format!("{:?}", get(&store, former.id).await), before);
    }
}

pub async fn a_job_that_kills_its_workers_is_parked(store: Arc<RecordStore>) {
    let id = enqueued(&store, &job()).await.id;
    for attempt in 1..=RULES.interruptions {
        assert_eq!(claim_soon(&store).await.attempt, attempt);
        swept(&store).await;
    }
    let parked = get(&store, id).await;
    assert_eq!(
        (parked.state, parked.lost, parked.interrupted),
        (State::Failed, 0, RULES.interruptions)
    );
    assert_eq!(parked.failure.expect("a cause").code, "worker_lost");
    assert!(claim(&store).await.is_none());
}

/// What may kill its workers is computed by one that computes nothing else.
pub async fn a_suspect_goes_to_a_free_worker(store: Arc<RecordStore>) {
    let suspect = enqueued(&store, &job()).await.id;
    for _ in 0..SUSPECT {
        assert_eq!(claim_soon(&store).await.id, suspect);
        swept(&store).await;
    }
    let other = enqueued(&store, &job()).await.id;
    let busy = Share {
        is_busy: true,
        ..Share::default()
    };
    let claimed = store.claim(WorkerId::fresh(), busy).await;
    assert_eq!(claimed.expect("an answer").map(|job| job.id), Some(other));
    let none = store.claim(WorkerId::fresh(), busy).await;
    assert!(none.expect("an answer").is_none());
    assert_eq!(claim_soon(&store).await.id, suspect);
}

pub async fn all_is_abandoned_at_once(store: Arc<RecordStore>) {
    for _ in 0..150 {
        enqueued(&store, &job()).await;
    }
    while claim(&store).await.is_some() {}
    let abandoned = store.sweep(Sweep::Abandoned).await.expect("an answer");
    assert_eq!(abandoned.len(), 150);
    assert!(abandoned.iter().all(|job| job.state == State::Queued));
}
