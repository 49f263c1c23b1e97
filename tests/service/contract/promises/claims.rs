//! Who gets which job.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::future::join_all;
use unwrapd::jobs::access::Owner;
use unwrapd::jobs::{Ending, Job, JobId, JobStore, Share, State, Transition, WorkerId};
use unwrapd::store::RecordStore;
use unwrapd_api::Verdict;

use super::get;
use crate::contract::{RULES, change, claim, claim_soon, claimed, enqueued, job, report, yes};

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

/// Puts jobs of an owner into a store.
async fn of_owner(store: &RecordStore, owner: &str, priorities: &[i32]) -> Vec<JobId> {
    let owner: Owner = owner.parse().expect("a name");
    let mut ids = Vec::new();
    for &priority in priorities {
        let owner = owner.clone();
        let job = Job {
            owner,
            priority,
            ..job()
        };
        ids.push(enqueued(store, &job).await.id);
    }
    ids
}

async fn owners_claimed(store: &RecordStore, count: usize) -> Vec<String> {
    let mut owners = Vec::new();
    for _ in 0..count {
        let claimed = claim(store).await.expect("it waits");
        owners.push(claimed.owner.as_str().to_owned());
    }
    owners
}

pub async fn owners_take_turns_whatever_their_priorities(store: Arc<RecordStore>) {
    let many = of_owner(&store, "many", &[0, 100, 100, 100, 100, 100]).await;
    of_owner(&store, "few", &[-100, -100]).await;
    of_owner(&store, "one", &[0]).await;
    let first = owners_claimed(&store, 3).await;
    let expected: HashSet<&str> = ["many", "few", "one"].into();
    assert_eq!(
        first.iter().map(String::as_str).collect::<HashSet<_>>(),
        expected
    );
    let then = owners_claimed(&store, 2).await;
    assert_eq!(
        then.iter().map(String::as_str).collect::<HashSet<_>>(),
        ["many", "few"].into()
    );
    assert_eq!(owners_claimed(&store, 3).await, ["many"; 3]);
    let last = claim(&store).await.expect("it waits");
    assert_eq!(last.id, many[0], "priorities hold within an owner");
}

/// Whoever has a long job running does not get the next slot before those who have none.
pub async fn the_owner_with_the_fewest_running_is_next(store: Arc<RecordStore>) {
    of_owner(&store, "long", &[0, 0, 0]).await;
    assert_eq!(owners_claimed(&store, 1).await, ["long"]);
    of_owner(&store, "short", &[0, 0]).await;
    for _ in 0..2 {
        let short = claim(&store).await.expect("it waits");
        assert_eq!(short.owner.as_str(), "short");
        let ending = Ending::Succeeded(Vec::new(), Verdict::default());
        let ended = Transition::Ended(short.token, report(short.seq, 1.0), ending);
        yes(change(&store, short.id, ended).await);
    }
    assert_eq!(owners_claimed(&store, 1).await, ["long"]);
}

pub async fn an_owner_has_no_more_running_than_allowed(store: Arc<RecordStore>) {
    of_owner(&store, "many", &[0; 12]).await;
    let share = Share {
        of_owner: Some(3),
        ..Share::default()
    };
    let worker = async || {
        let mut count = 0;
        for _ in 0..3 {
            let claimed = store.claim(WorkerId::fresh(), share).await;
            count += usize::from(claimed.expect("an answer").is_some());
        }
        count
    };
    let all: usize = join_all((0..6).map(|_| worker())).await.into_iter().sum();
    assert!((1..=3).contains(&all), "{all}");
    of_owner(&store, "other", &[0]).await;
    let other = store.claim(WorkerId::fresh(), share).await;
    let other = other.expect("an answer").expect("it waits");
    assert_eq!(other.owner.as_str(), "other");
}

pub async fn the_reserve_takes_small_jobs_only(store: Arc<RecordStore>) {
    let mut large = job();
    large.input[0].bytes = 101;
    enqueued(&store, &large).await;
    let small = enqueued(&store, &job()).await;
    let share = Share {
        largest: Some(100),
        ..Share::default()
    };
    let claim = async || {
        store
            .claim(WorkerId::fresh(), share)
            .await
            .expect("an answer")
    };
    assert_eq!(claim().await.map(|job| job.id), Some(small.id));
    assert!(claim().await.is_none());
}

pub async fn nothing_is_claimed_in_a_pause(store: Arc<RecordStore>) {
    enqueued(&store, &job()).await;
    for _ in 0..2 {
        store.set_paused(true).await.expect("an answer");
    }
    assert!(store.is_paused().await.expect("an answer"));
    assert!(claim(&store).await.is_none());
    store.set_paused(false).await.expect("an answer");
    assert!(!store.is_paused().await.expect("an answer"));
    assert!(claim(&store).await.is_some());
}

pub async fn no_job_is_claimed_twice(store: Arc<RecordStore>) {
    for _ in 0..40 {
        enqueued(&store, &job()).await;
    }
    let worker = async || {
        let mut mine = Vec::new();
        while let Some(job) =
            (store.claim(WorkerId::fresh(), Share::default()).await).expect("an answer")
        {
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
    let pause = Ending::Requeued(RULES.pause);
    let back = Transition::Ended(job.token, report(job.seq + 1, 0.5), pause);
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
    let back = Ending::Requeued(Duration::ZERO);
    yes(change(
        &store,
        lost.id,
        Transition::Ended(lost.token, report(0, 0.0), back),
    )
    .await);
    assert_eq!(claim_soon(&store).await.id, lost.id);
}
