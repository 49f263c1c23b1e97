//! Jobs that end, are tried again, and are removed.

use std::sync::Arc;
use std::time::Duration;

use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{
    Changed, Command, Ending, Enqueued, IdempotencyKey, JobId, JobStore, Reason, Refusal, State,
    Transition,
};
use unwrapd::store::RecordStore;
use unwrapd_api::Failure;

use super::{get, succeed};
use crate::contract::{ROOM, change, claim, claim_soon, claimed, enqueued, job, report, yes};

pub async fn an_end_is_recorded_once(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let ended = succeed(&store, &job).await;
    assert_eq!(
        (ended.state, ended.progress.fraction),
        (State::Succeeded, 1.0)
    );
    assert_eq!(store.stored_bytes().await.expect("an answer"), 111);
    let again = succeed(&store, &job).await;
    assert_eq!(format!("{again:?}"), format!("{ended:?}"));
    let failure = Ending::Failed(Failure::new("crashed", "it did"));
    let other = Transition::Ended(job.token - 1, report(0, 0.0), failure);
    let refused = change(&store, job.id, other).await;
    assert!(matches!(refused, Changed::No(_, Refusal::Outdated)));
    assert_eq!(
        format!("{:?}", get(&store, job.id).await),
        format!("{ended:?}")
    );
    let missing = change(&store, JobId::fresh(), Transition::Swept).await;
    assert!(matches!(missing, Changed::Missing));
}

pub async fn a_queued_job_is_cancelled_at_once(store: Arc<RecordStore>) {
    let new = enqueued(&store, &job()).await;
    let cancelled = yes(change(&store, new.id, Transition::Commanded(Command::Cancel)).await);
    assert_eq!(cancelled.state, State::Cancelled);
    assert_eq!(store.stored_bytes().await.expect("an answer"), 0);
    assert!(claim(&store).await.is_none());
    let again = change(&store, new.id, Transition::Commanded(Command::Cancel)).await;
    assert!(matches!(again, Changed::No(_, Refusal::WrongState)));
}

pub async fn only_a_failed_job_is_tried_again(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let retry = async || change(&store, job.id, Transition::Commanded(Command::Retry)).await;
    assert!(matches!(retry().await, Changed::No(_, Refusal::WrongState)));
    let failure = Ending::Failed(Failure::new("no_uvs", "there are none"));
    let end = Transition::Ended(job.token, report(job.seq, 0.5), failure.clone());
    yes(change(&store, job.id, end).await);
    let failed = get(&store, job.id).await;
    assert_eq!(failed.failure.expect("a cause").code, "no_uvs");
    let retried = yes(retry().await);
    assert_eq!((retried.failure, retried.finished), (None, None));
    let again = claim_soon(&store).await;
    assert_eq!((again.id, again.attempt), (job.id, 2));
    assert!(job.seq < again.seq);
}

pub async fn only_ended_jobs_are_deleted(store: Arc<RecordStore>) {
    let key = IdempotencyKey {
        key: "k".to_owned(),
        fingerprint: "f".to_owned(),
    };
    let one = async || {
        store
            .enqueue(&job(), Some(&key), ROOM)
            .await
            .expect("an answer")
    };
    let Enqueued::New(job) = one().await else {
        panic!("it is new")
    };
    let delete = async || {
        store
            .delete(&Visibility::All, job.id, Reason::Deleted)
            .await
            .expect("an answer")
    };
    assert!(!delete().await);
    let running = claim(&store).await.expect("it waits");
    assert!(!delete().await);
    succeed(&store, &running).await;
    assert!(delete().await);
    assert!(!delete().await);
    assert!(
        !store
            .has_expired(&Visibility::All, job.id)
            .await
            .expect("an answer")
    );
    assert!(matches!(one().await, Enqueued::New(_)));
}

pub async fn what_expired_is_remembered(store: Arc<RecordStore>) {
    let running = claimed(&store).await;
    let ended = async |kept| store.ended_before(kept).await.expect("an answer");
    assert!(ended(Duration::ZERO).await.is_empty());
    succeed(&store, &running).await;
    assert!(ended(Duration::from_hours(1)).await.is_empty());
    while ended(Duration::ZERO).await != [running.id] {}
    assert!(
        store
            .delete(&Visibility::All, running.id, Reason::Expired)
            .await
            .expect("an answer")
    );
    assert!(
        store
            .has_expired(&Visibility::All, running.id)
            .await
            .expect("an answer")
    );
    assert!(
        store
            .get(&Visibility::All, running.id)
            .await
            .expect("an answer")
            .is_none()
    );
}
