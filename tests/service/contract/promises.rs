//! What every store of records promises: the same functions run over SQLite and PostgreSQL.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::future::{BoxFuture, FutureExt, join_all};
use unwrapd::jobs::{
    Capacity, Changed, Ending, Enqueued, Failure, Happening, IdempotencyKey, Job, JobId, JobStore,
    Listing, OutputFile, Reason, Refusal, State, Sweep, Timestamp, Verdict, Wish, WorkerId,
};
use unwrapd::store::RecordStore;

use super::{ROOM, RULES, change, claim, claim_soon, claimed, enqueued, job, saying, yes};
use crate::harness::postgres::Postgres;

type Promise = fn(Arc<RecordStore>) -> BoxFuture<'static, ()>;

/// All promises, by their names.
macro_rules! promises {
    ($($name:ident),* $(,)?) => {
        const PROMISES: &[(&str, Promise)] =
            &[$((stringify!($name), |store| $name(store).boxed())),*];
    };
}

promises!(
    what_is_stored_is_found,
    the_oldest_is_claimed_first,
    the_highest_priority_is_claimed_first,
    no_job_is_claimed_twice,
    an_end_is_recorded_once,
    a_beat_renews_the_lease_and_brings_wishes,
    beats_are_answered_in_their_order,
    a_silent_worker_loses_its_job,
    a_former_holder_changes_nothing,
    a_job_that_kills_its_workers_is_parked,
    a_job_handed_back_waits_and_counts_no_loss,
    a_retry_does_not_wait_behind_the_backlog,
    all_is_abandoned_at_once,
    a_queued_job_is_cancelled_at_once,
    only_a_failed_job_is_tried_again,
    the_depth_holds_under_contention,
    the_quota_holds_under_contention,
    a_key_makes_one_job_under_contention,
    only_ended_jobs_are_deleted,
    what_expired_is_remembered,
    events_are_those_of_the_records,
    the_list_has_pages_and_no_guests,
    equal_jobs_are_those_that_succeeded,
    an_ended_job_is_stored_however_many_wait,
);

#[tokio::test]
async fn sqlite_keeps_all_promises() {
    for (name, promise) in PROMISES {
        println!("{name}");
        let folder = tempfile::tempdir().expect("a folder");
        let url = format!("sqlite://{}/jobs?mode=rwc", folder.path().display());
        let store = RecordStore::open(&url, RULES).await.expect("a store");
        promise(Arc::new(store)).await;
    }
}

#[tokio::test]
async fn postgres_keeps_all_promises() {
    let postgres = Postgres::start();
    for (name, promise) in PROMISES {
        println!("{name}");
        let url = postgres.database(name);
        let store = RecordStore::open(&url, RULES).await.expect("a store");
        promise(Arc::new(store)).await;
    }
}

/// During a rolling update a newer program adds columns while older ones go on.
#[tokio::test]
async fn postgres_serves_who_has_used_an_older_schema() {
    let postgres = Postgres::start();
    let url = postgres.database("updated");
    let store = RecordStore::open(&url, RULES).await.expect("a store");
    let key = IdempotencyKey {
        key: "a key".to_owned(),
        fingerprint: "a mesh".to_owned(),
    };
    let use_all = async || {
        let new = job();
        let made = store.enqueue(&new, Some(&key), ROOM).await;
        made.expect("an answer");
        for _ in 0..2 {
            enqueued(&store, &job()).await;
        }
        let claimed = claim(&store).await.expect("it waits");
        let beat = (claimed.id, claimed.token, saying(claimed.seq, 0.5));
        store.beat(&[beat]).await.expect("an answer");
        succeed(&store, &claimed).await;
        get(&store, claimed.id).await;
        let listing = Listing {
            state: None,
            before: None,
            limit: 9,
        };
        store.list(listing).await.expect("an answer");
        store.equal("cd").await.expect("an answer");
        store.events(&[claimed.id]).await.expect("an answer");
        claim(&store).await.expect("it waits");
        store.sweep(Sweep::Abandoned).await.expect("an answer");
        claim_soon(&store).await;
    };
    use_all().await;
    let newer = "ALTER TABLE job ADD COLUMN newer BIGINT NOT NULL DEFAULT 0";
    postgres.psql("updated", newer);
    use_all().await;
}

async fn get(store: &RecordStore, id: JobId) -> Job {
    store.get(id).await.expect("an answer").expect("a job")
}

fn success() -> Ending {
    let output = OutputFile {
        role: "result".to_owned(),
        name: "mesh.glb".to_owned(),
        bytes: 11,
        sha256: None,
    };
    Ending::Succeeded(vec![output], Verdict::default())
}

async fn succeed(store: &RecordStore, job: &Job) -> Job {
    let happening = Happening::Ended(job.token, saying(job.seq, 0.5), success());
    yes(change(store, job.id, happening).await)
}

/// Sweeps until something is found: leases end by the clock of the store.
async fn swept(store: &RecordStore) -> Vec<Job> {
    loop {
        let swept = store.sweep(Sweep::Overdue).await.expect("an answer");
        if !swept.is_empty() {
            return swept;
        }
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
}

async fn what_is_stored_is_found(store: Arc<RecordStore>) {
    let new = enqueued(&store, &job()).await;
    assert!(new.created.since(Timestamp(1_600_000_000_000)) > 0);
    let found = get(&store, new.id).await;
    assert_eq!(format!("{found:?}"), format!("{new:?}"));
    assert!(
        store
            .get(JobId::fresh())
            .await
            .expect("an answer")
            .is_none()
    );
    let counts = store.counts().await.expect("an answer");
    assert_eq!(counts[0], (State::Queued, 1));
    assert_eq!(store.stored_bytes().await.expect("an answer"), 100);
    store.check().await.expect("it can be written to");
}

async fn the_oldest_is_claimed_first(store: Arc<RecordStore>) {
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

async fn the_highest_priority_is_claimed_first(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for priority in [0, -5, 7, 0, 7] {
        let job = Job { priority, ..job() };
        ids.push(enqueued(&store, &job).await.id);
    }
    for index in [2, 4, 0, 3, 1] {
        assert_eq!(claim(&store).await.map(|job| job.id), Some(ids[index]));
    }
}

async fn no_job_is_claimed_twice(store: Arc<RecordStore>) {
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

async fn an_end_is_recorded_once(store: Arc<RecordStore>) {
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
    let other = Happening::Ended(job.token - 1, saying(0, 0.0), failure);
    let refused = change(&store, job.id, other).await;
    assert!(matches!(refused, Changed::No(_, Refusal::Outdated)));
    assert_eq!(
        format!("{:?}", get(&store, job.id).await),
        format!("{ended:?}")
    );
    let missing = change(&store, JobId::fresh(), Happening::Swept).await;
    assert!(matches!(missing, Changed::Missing));
}

async fn a_beat_renews_the_lease_and_brings_wishes(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let first = job.lease.expect("a lease");
    for wish in [Wish::FinishEarly, Wish::Cancel] {
        yes(change(&store, job.id, Happening::Wished(wish)).await);
    }
    let mut seq = job.seq;
    // Longer than a lease, and nobody takes the job.
    loop {
        seq += 1;
        let beat = (job.id, job.token, saying(seq, 0.25));
        let answers = store.beat(&[beat]).await.expect("an answer");
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

async fn beats_are_answered_in_their_order(store: Arc<RecordStore>) {
    for _ in 0..3 {
        enqueued(&store, &job()).await;
    }
    let mut jobs = Vec::new();
    while let Some(job) = claim(&store).await {
        jobs.push(job);
    }
    jobs.reverse();
    succeed(&store, &jobs[1]).await;
    let mut beats: Vec<_> = jobs
        .iter()
        .map(|job| (job.id, job.token, saying(job.seq, 0.0)))
        .collect();
    beats[2].1 += 1;
    beats.push((JobId::fresh(), 1, saying(1, 0.0)));
    let answers = store.beat(&beats).await.expect("an answer");
    assert_eq!(yes(answers[0].clone()).id, jobs[0].id);
    assert!(matches!(&answers[1], Changed::No(job, Refusal::WrongState) if job.id == jobs[1].id));
    assert!(matches!(&answers[2], Changed::No(job, Refusal::Outdated) if job.id == jobs[2].id));
    assert!(matches!(answers[3], Changed::Missing));
}

async fn a_silent_worker_loses_its_job(store: Arc<RecordStore>) {
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
    assert_eq!((swept[0].state, swept[0].lost), (State::Queued, 1));
    assert_eq!(swept[0].token, job.token + 1);
    let again = claim_soon(&store).await;
    assert_eq!((again.attempt, again.token), (2, job.token + 2));
}

async fn a_former_holder_changes_nothing(store: Arc<RecordStore>) {
    let former = claimed(&store).await;
    swept(&store).await;
    // While the job waits, and while somebody else has it.
    for is_held in [false, true] {
        if is_held {
            claim_soon(&store).await;
        }
        let before = format!("{:?}", get(&store, former.id).await);
        let beat = (former.id, former.token, saying(former.seq + 5, 0.9));
        let answers = store.beat(&[beat]).await.expect("an answer");
        assert!(matches!(answers[0], Changed::No(_, Refusal::Outdated)));
        let end = Happening::Ended(former.token, beat.2, success());
        let end = change(&store, former.id, end).await;
        assert!(matches!(end, Changed::No(_, Refusal::Outdated)));
        assert_eq!(format!("{:?}", get(&store, former.id).await), before);
    }
}

async fn a_job_that_kills_its_workers_is_parked(store: Arc<RecordStore>) {
    let id = enqueued(&store, &job()).await.id;
    for attempt in 1..=RULES.attempts {
        assert_eq!(claim_soon(&store).await.attempt, attempt);
        swept(&store).await;
    }
    let parked = get(&store, id).await;
    assert_eq!((parked.state, parked.lost), (State::Failed, 3));
    assert_eq!(parked.failure.expect("a cause").code, "worker_lost");
    assert!(claim(&store).await.is_none());
}

async fn a_job_handed_back_waits_and_counts_no_loss(store: Arc<RecordStore>) {
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

async fn a_retry_does_not_wait_behind_the_backlog(store: Arc<RecordStore>) {
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

async fn all_is_abandoned_at_once(store: Arc<RecordStore>) {
    for _ in 0..150 {
        enqueued(&store, &job()).await;
    }
    while claim(&store).await.is_some() {}
    let abandoned = store.sweep(Sweep::Abandoned).await.expect("an answer");
    assert_eq!(abandoned.len(), 150);
    assert!(abandoned.iter().all(|job| job.state == State::Queued));
}

async fn a_queued_job_is_cancelled_at_once(store: Arc<RecordStore>) {
    let new = enqueued(&store, &job()).await;
    let cancelled = yes(change(&store, new.id, Happening::Wished(Wish::Cancel)).await);
    assert_eq!(cancelled.state, State::Cancelled);
    assert_eq!(store.stored_bytes().await.expect("an answer"), 0);
    assert!(claim(&store).await.is_none());
    let again = change(&store, new.id, Happening::Wished(Wish::Cancel)).await;
    assert!(matches!(again, Changed::No(_, Refusal::WrongState)));
}

async fn only_a_failed_job_is_tried_again(store: Arc<RecordStore>) {
    let job = claimed(&store).await;
    let retry = async || change(&store, job.id, Happening::Wished(Wish::Retry)).await;
    assert!(matches!(retry().await, Changed::No(_, Refusal::WrongState)));
    let failure = Ending::Failed(Failure::new("no_uvs", "there are none"));
    let end = Happening::Ended(job.token, saying(job.seq, 0.5), failure.clone());
    yes(change(&store, job.id, end).await);
    let failed = get(&store, job.id).await;
    assert_eq!(failed.failure.expect("a cause").code, "no_uvs");
    let retried = yes(retry().await);
    assert_eq!((retried.failure, retried.finished), (None, None));
    let again = claim_soon(&store).await;
    assert_eq!((again.id, again.attempt), (job.id, 2));
    assert!(job.seq < again.seq);
}

async fn the_depth_holds_under_contention(store: Arc<RecordStore>) {
    let few = Capacity { depth: 5, ..ROOM };
    let one = async || store.enqueue(&job(), None, few).await.expect("an answer");
    let answers = join_all((0..20).map(|_| one())).await;
    let new = answers.iter().filter(|it| matches!(it, Enqueued::New(_)));
    assert_eq!(new.count(), 5);
    assert_eq!(store.counts().await.expect("an answer")[0].1, 5);
}

async fn the_quota_holds_under_contention(store: Arc<RecordStore>) {
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

async fn a_key_makes_one_job_under_contention(store: Arc<RecordStore>) {
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
    assert_eq!(store.counts().await.expect("an answer")[0].1, 1);
}

async fn only_ended_jobs_are_deleted(store: Arc<RecordStore>) {
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
            .delete(job.id, Reason::Deleted)
            .await
            .expect("an answer")
    };
    assert!(!delete().await);
    let running = claim(&store).await.expect("it waits");
    assert!(!delete().await);
    succeed(&store, &running).await;
    assert!(delete().await);
    assert!(!delete().await);
    assert!(!store.has_expired(job.id).await.expect("an answer"));
    assert!(matches!(one().await, Enqueued::New(_)));
}

async fn what_expired_is_remembered(store: Arc<RecordStore>) {
    let running = claimed(&store).await;
    let ended = async |kept| store.ended_before(kept).await.expect("an answer");
    assert!(ended(Duration::ZERO).await.is_empty());
    succeed(&store, &running).await;
    assert!(ended(Duration::from_hours(1)).await.is_empty());
    while ended(Duration::ZERO).await != [running.id] {}
    assert!(
        store
            .delete(running.id, Reason::Expired)
            .await
            .expect("an answer")
    );
    assert!(store.has_expired(running.id).await.expect("an answer"));
    assert!(store.get(running.id).await.expect("an answer").is_none());
}

async fn events_are_those_of_the_records(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for _ in 0..70 {
        ids.push(enqueued(&store, &job()).await.id);
    }
    let running = claim(&store).await.expect("it waits");
    let beat = (running.id, running.token, saying(running.seq + 3, 0.75));
    store.beat(&[beat]).await.expect("an answer");
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

async fn the_list_has_pages_and_no_guests(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for ephemeral in [false, true, false, false] {
        let job = Job { ephemeral, ..job() };
        ids.push(enqueued(&store, &job).await.id);
    }
    assert_eq!(store.ephemeral().await.expect("an answer"), [ids[1]]);
    let page = async |state, before, limit| {
        let listing = Listing {
            state,
            before,
            limit,
        };
        let page = store.list(listing).await.expect("an answer");
        page.iter().map(|job| job.id).collect::<Vec<_>>()
    };
    assert_eq!(page(None, None, 2).await, [ids[3], ids[2]]);
    assert_eq!(page(None, Some(ids[2]), 2).await, [ids[0]]);
    claim(&store).await.expect("it waits");
    assert_eq!(page(Some(State::Running), None, 9).await, [ids[0]]);
    assert!(page(Some(State::Failed), None, 9).await.is_empty());
}

async fn equal_jobs_are_those_that_succeeded(store: Arc<RecordStore>) {
    let equal = async |digest| {
        let equal = store.equal(digest).await.expect("an answer");
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

async fn an_ended_job_is_stored_however_many_wait(store: Arc<RecordStore>) {
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
