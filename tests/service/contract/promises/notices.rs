//! Ends that are told.

use std::sync::Arc;
use std::time::Duration;

use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{Command, Ending, Job, JobStore, Notice, Outbox, State, Transition};
use unwrapd::store::RecordStore;
use unwrapd_api::Failure;

use super::succeed;
use crate::contract::{change, claim, enqueued, job, report};

const LONG: Duration = Duration::from_mins(1);

fn told() -> Job {
    Job {
        webhook: Some("https://example.org/hook".parse().expect("an address")),
        ..job()
    }
}

async fn taken(store: &RecordStore, lease: Duration) -> Vec<Notice> {
    store.take(9, lease).await.expect("an answer")
}

fn state_of(notice: &Notice) -> String {
    let body: serde_json::Value = serde_json::from_str(&notice.body).expect("JSON");
    body["data"]["state"].as_str().expect("a state").to_owned()
}

pub async fn an_end_is_told_until_it_is_settled(store: Arc<RecordStore>) {
    enqueued(&store, &told()).await;
    let running = claim(&store).await.expect("it waits");
    assert!(taken(&store, LONG).await.is_empty());
    succeed(&store, &running).await;
    // A worker that had no answer reports its end again.
    succeed(&store, &running).await;
    let first = taken(&store, LONG).await;
    assert_eq!((first.len(), first[0].attempt), (1, 1));
    assert_eq!(first[0].webhook, running.webhook.expect("an address"));
    assert!(taken(&store, LONG).await.is_empty(), "it is somebody's");
    store
        .defer(&first[0].id, Duration::ZERO)
        .await
        .expect("an answer");
    let again = taken(&store, Duration::ZERO).await;
    assert_eq!((&again[0].id, again[0].attempt), (&first[0].id, 2));
    assert_eq!(again[0].body, first[0].body);
    // Whoever had it died.
    assert_eq!(taken(&store, LONG).await[0].attempt, 3);
    store.settle(&first[0].id).await.expect("an answer");
    store
        .defer(&first[0].id, Duration::ZERO)
        .await
        .expect("an answer");
    assert!(taken(&store, LONG).await.is_empty());
}

pub async fn every_end_is_told_and_nothing_else(store: Arc<RecordStore>) {
    let ended = Job {
        state: State::Succeeded,
        finished: Some(told().created),
        ..told()
    };
    enqueued(&store, &ended).await;
    let cancelled = enqueued(&store, &told()).await;
    let command = Transition::Commanded(Command::Cancel);
    store
        .change(&Visibility::All, cancelled.id, &command)
        .await
        .expect("an answer");
    enqueued(&store, &told()).await;
    let failing = claim(&store).await.expect("it waits");
    let failed = Ending::Failed(Failure::new("no_uvs", "there are none"));
    let failed = Transition::Ended(failing.token, report(failing.seq, 0.5), failed);
    change(&store, failing.id, failed).await;
    // Nobody wants to know of this one.
    enqueued(&store, &job()).await;
    let untold = claim(&store).await.expect("it waits");
    succeed(&store, &untold).await;
    let mut states: Vec<String> = taken(&store, LONG).await.iter().map(state_of).collect();
    states.sort();
    assert_eq!(states, ["cancelled", "failed", "succeeded"]);
}

pub async fn a_notice_is_taken_once(store: Arc<RecordStore>) {
    for _ in 0..20 {
        enqueued(&store, &told()).await;
        let running = claim(&store).await.expect("it waits");
        succeed(&store, &running).await;
    }
    let take = async || {
        let mut ids = Vec::new();
        for _ in 0..10 {
            let some = store.take(3, LONG).await.expect("an answer");
            ids.extend(some.into_iter().map(|notice| notice.id));
        }
        ids
    };
    let (a, b, c) = tokio::join!(take(), take(), take());
    let mut ids = [a, b, c].concat();
    assert_eq!(ids.len(), 20);
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), 20);
}
