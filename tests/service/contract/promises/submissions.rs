//! Jobs that are taken in, at the same time and beyond what there is room for.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::future::join_all;
use unwrapd::jobs::{
    Capacity, Ending, Enqueued, IdempotencyKey, Job, JobId, JobStore, OwnerQuota, OwnerQuotas,
    ProgressReport, State, Timestamp, Transition,
};
use unwrapd::store::RecordStore;
use unwrapd_api::Verdict;

use super::get;
use crate::contract::{ROOM, change, claim, job, report, yes};

pub async fn the_depth_holds_under_contention(store: Arc<RecordStore>) {
    let few = Capacity { depth: 5, ..ROOM };
    let one = async || store.enqueue(&job(), None, few).await.expect("an answer");
    let answers = join_all((0..20).map(|_| one())).await;
    let new = answers.iter().filter(|it| matches!(it, Enqueued::New(_)));
    assert_eq!(new.count(), 5);
    assert_eq!(store.queue().await.expect("an answer").counts[0].1, 5);
}

pub async fn the_quota_holds_under_contention(store: Arc<RecordStore>) {
    let little = Capacity {
        bytes: Some(350),
        ..ROOM
    };
    let one = async || {
        store
            .enqueue(&job(), None, little)
            .await
            .expect("an answer")
    };
    let answers = join_all((0..20).map(|_| one())).await;
    let refused = answers
        .iter()
        .filter(|it| matches!(it, Enqueued::OverQuota));
    assert_eq!(refused.count(), 17);
    assert_eq!(store.stored_bytes().await.expect("an answer"), 300);
}

/// Which quota refused a job of an owner, if one did.
async fn refused(store: &RecordStore, owner: &str, quotas: OwnerQuotas) -> Option<OwnerQuota> {
    let capacity = Capacity {
        of_owner: quotas,
        ..ROOM
    };
    let owner = owner.parse().expect("a name");
    let job = Job { owner, ..job() };
    match store.enqueue(&job, None, capacity).await {
        Ok(Enqueued::New(_)) => None,
        Ok(Enqueued::OwnerOverQuota(quota)) => Some(quota),
        other => panic!("{other:?}"),
    }
}

pub async fn an_owner_has_no_more_jobs_and_bytes_than_allowed(store: Arc<RecordStore>) {
    let none = OwnerQuotas::default();
    let jobs = OwnerQuotas {
        jobs: Some(2),
        ..none
    };
    assert_eq!(refused(&store, "alice", jobs).await, None);
    assert_eq!(refused(&store, "alice", jobs).await, None);
    assert_eq!(refused(&store, "alice", jobs).await, Some(OwnerQuota::Jobs));
    assert_eq!(refused(&store, "bob", jobs).await, None);
    let bytes = OwnerQuotas {
        bytes: Some(299),
        ..none
    };
    assert_eq!(
        refused(&store, "alice", bytes).await,
        Some(OwnerQuota::Bytes)
    );
    assert_eq!(refused(&store, "bob", bytes).await, None);
}

pub async fn an_owner_uses_no_more_processor_time_than_allowed(store: Arc<RecordStore>) {
    let cpu = OwnerQuotas {
        cpu_of_day: Some(Duration::from_secs(3)),
        ..OwnerQuotas::default()
    };
    for quota in [None, None, Some(OwnerQuota::Cpu)] {
        assert_eq!(refused(&store, "alice", cpu).await, quota);
        let Some(job) = claim(&store).await else {
            continue;
        };
        let said = ProgressReport {
            cpu_ms: 2000,
            ..report(job.seq, 1.0)
        };
        let ending = Ending::Succeeded(Vec::new(), Verdict::default());
        let ended = Transition::Ended(job.token, said, ending);
        // What is said twice is counted once.
        for _ in 0..2 {
            yes(change(&store, job.id, ended.clone()).await);
        }
    }
    assert_eq!(refused(&store, "bob", cpu).await, None);
}

pub async fn a_key_makes_one_job_under_contention(store: Arc<RecordStore>) {
    let key = |fingerprint: &str| IdempotencyKey {
        key: "night-run".to_owned(),
        fingerprint: fingerprint.to_owned(),
    };
    let (same, other) = (key("a"), key("b"));
    let one = async || {
        store
            .enqueue(&job(), Some(&same), ROOM)
            .await
            .expect("an answer")
    };
    let answers = join_all((0..12).map(|_| one())).await;
    let ids: HashSet<JobId> = answers
        .iter()
        .map(|answer| match answer {
            Enqueued::New(job) | Enqueued::Replay(job) => job.id,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(ids.len(), 1);
    let new = answers.iter().filter(|it| matches!(it, Enqueued::New(_)));
    assert_eq!(new.count(), 1);
    let reused = store.enqueue(&job(), Some(&other), ROOM).await;
    assert!(matches!(reused.expect("an answer"), Enqueued::KeyReused));
    assert_eq!(store.queue().await.expect("an answer").counts[0].1, 1);
}

pub async fn an_ended_job_is_stored_however_many_wait(store: Arc<RecordStore>) {
    let none = Capacity {
        depth: 0,
        bytes: None,
        ..ROOM
    };
    let ended = Job {
        state: State::Succeeded,
        finished: Some(Timestamp(0)),
        ..job()
    };
    let stored = store.enqueue(&ended, None, none).await.expect("an answer");
    let Enqueued::New(stored) = stored else {
        panic!("{stored:?}");
    };
    assert_eq!(stored.finished, Some(stored.created));
    let found = get(&store, stored.id).await;
    assert_eq!(format!("{found:?}"), format!("{stored:?}"));
    assert!(claim(&store).await.is_none());
    let refused = store.enqueue(&job(), None, none).await.expect("an answer");
    assert!(matches!(refused, Enqueued::Full), "{refused:?}");
}
