//! Jobs that are looked for.

use std::sync::Arc;

use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{Job, JobId, JobStore, State, Timestamp};
use unwrapd::store::RecordStore;

use super::{get, succeed};
use crate::contract::{claim, claimed, enqueued, job, report};

pub async fn what_is_stored_is_found(store: Arc<RecordStore>) {
    let new = enqueued(&store, &job()).await;
    assert!(new.created.since(Timestamp(1_600_000_000_000)) > 0);
    let found = get(&store, new.id).await;
    assert_eq!(format!("{found:?}"), format!("{new:?}"));
    assert!(
        store
            .get(&Visibility::All, JobId::fresh())
            .await
            .expect("an answer")
            .is_none()
    );
    let counts = store.queue().await.expect("an answer").counts;
    assert_eq!(counts[0], (State::Queued, 1));
    assert_eq!(store.stored_bytes().await.expect("an answer"), 100);
    store.check().await.expect("it can be written to");
}

pub async fn events_are_those_of_the_records(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for _ in 0..70 {
        ids.push(enqueued(&store, &job()).await.id);
    }
    let running = claim(&store).await.expect("it waits");
    let heartbeat = (running.id, running.token, report(running.seq + 3, 0.75));
    store.heartbeat(&[heartbeat]).await.expect("an answer");
    ids.push(JobId::fresh());
    let mut events = store.events(&ids).await.expect("an answer");
    events.sort_by_key(|(id, _)| *id);
    let found: Vec<JobId> = events.iter().map(|(id, _)| *id).collect();
    assert_eq!(found, ids[..70]);
    let event = events[0].1;
    assert_eq!((event.state, event.seq), (State::Running, running.seq + 3));
    assert_eq!(event.progress.fraction, 0.75);
    assert_eq!(events[1].1.state, State::Queued);
    assert_eq!(store.events(&[]).await.expect("an answer"), []);
}

pub async fn equal_jobs_are_those_that_succeeded(store: Arc<RecordStore>) {
    let equal = async |digest: &str| {
        let wanted = Job {
            digest: digest.to_owned(),
            ..job()
        };
        let equal = store.equal(&wanted).await.expect("an answer");
        equal.into_iter().map(|job| job.id).collect::<Vec<_>>()
    };
    let first = claimed(&store).await;
    assert!(equal("cd").await.is_empty());
    succeed(&store, &first).await;
    assert_eq!(equal("cd").await, [first.id]);
    assert!(equal("other").await.is_empty());
    let guest = Job {
        ephemeral: true,
        ..job()
    };
    enqueued(&store, &guest).await;
    let guest = claim(&store).await.expect("it waits");
    succeed(&store, &guest).await;
    let second = claimed(&store).await;
    succeed(&store, &second).await;
    assert_eq!(equal("cd").await, [second.id, first.id]);
}
