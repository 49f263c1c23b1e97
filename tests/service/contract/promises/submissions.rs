//! Jobs that are taken in, at the same time and beyond what there is room for.

use std::collections::HashSet;
use std::sync::Arc;

use futures_util::future::join_all;
use unwrapd::jobs::{Capacity, Enqueued, IdempotencyKey, Job, JobId, JobStore, State, Timestamp};
use unwrapd::store::RecordStore;

use super::get;
use crate::contract::{ROOM, claim, job};

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
