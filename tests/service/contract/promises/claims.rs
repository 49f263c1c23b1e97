//! Who gets which job.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::future::join_all;
use unwrapd::jobs::{Ending, Happening, Job, JobId, JobStore, State, WorkerId};
use unwrapd::store::RecordStore;

use super::get;
use crate::contract::{RULES, change, claim, claim_soon, claimed, enqueued, job, saying, yes};

pub async fn the_oldest_is_claimed_first(store: Arc<RecordStore>) {
    let jobs = [job(), job(), job()];
    for job in &jobs {
        enqueued(&store, job).await;
    }
    for job in &jobs {
        let claimed = claim(&store).await.expect("it waits");
        assert_eq!((claimed.id, claimed.token), (job.id, 1));
        let stored = get(&store, job.id).await;
        assert_eq!(format!("{stored:?}"), format!("{claimed:?}"));
    }
    assert!(claim(&store).await.is_none());
}

pub async fn the_highest_priority_is_claimed_first(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for priority in [0, -5, 7, 0, 7] {
        let job = Job { priority, ..job() };
        ids.push(enqueued(&store, &job).await.id);
    }
    for index in [2, 4, 0, 3, 1] {
        assert_eq!(claim(&store).await.map(|job| job.id), Some(ids[index]));
    }
}

pub async fn no_job_is_claimed_twice(store: Arc<RecordStore>) {
    for _ in 0..40 {
        enqueued(&store, &job()).await;
    }
    let worker = async || {
        let mut mine = Vec::new();
        while let Some(job) = store.claim(WorkerId::fresh()).await.expect("an answer") {
            mine.push(job.id);
        }
        mine
    };
    let all = join_all((0..8).map(|_| worker())).await.concat();
    assert!(all.len() <= 40);
    // Whoever finds a row kept by another may come away with nothing, and looks again.
    let mut claimed: HashSet<JobId> = all.iter().copied().collect();
    assert_eq!(claimed.len(), all.len());
    while let Some(job) = claim(&store).await {
        assert!(claimed.insert(job.id));
    }
    assert_eq!(claimed.len(), 40);
}

pub async fn a_job_handed_back_waits_and_counts_no_loss(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let pause = Ending::HandedBack(RULES.pause);
    let back = Happening::Ended(job.token, saying(job.seq + 1, 0.5), pause);
    let back = yes(change(&store, job.id, back).await);
    assert_eq!(
        (back.state, back.lost, back.progress.fraction),
        (State::Queued, 0, 0.5)
    );
    let again = claim_soon(&store).await;
    assert!(back.due <= again.started.expect("a time"));
}

pub async fn a_retry_does_not_wait_behind_the_backlog(store: Arc<RecordStore>) {
    let lost = claimed(&store).await;
    for _ in 0..3 {
        enqueued(&store, &job()).await;
    }
    let back = Ending::HandedBack(Duration::ZERO);
    yes(change(
        &store,
        lost.id,
        Happening::Ended(lost.token, saying(0, 0.0), back),
    )
    .await);
    assert_eq!(claim_soon(&store).await.id, lost.id);
}
