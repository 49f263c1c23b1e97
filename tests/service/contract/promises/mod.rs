//! What every store of records promises: the same functions run over SQLite and PostgreSQL.

mod claims;
mod ends;
mod keys;
mod leases;
mod lists;
mod lookups;
mod notices;
mod owners;
mod submissions;

use std::sync::Arc;
use std::time::Duration;

use futures_util::future::{BoxFuture, FutureExt};
use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{
    Ending, IdempotencyKey, Job, JobId, JobStore, Listing, Reason, Sweep, Transition,
};
use unwrapd::store::RecordStore;
use unwrapd_api::{OutputFile, Verdict};

use super::{ROOM, RULES, change, claim, claim_soon, enqueued, job, report, yes};
use crate::harness::postgres::Postgres;

type Promise = fn(Arc<RecordStore>) -> BoxFuture<'static, ()>;

/// All promises, by their names.
macro_rules! promises {
    ($($of:ident::$name:ident),* $(,)?) => {
        const PROMISES: &[(&str, Promise)] =
            &[$((stringify!($name), |store| $of::$name(store).boxed())),*];
    };
}

promises!(
    lookups::what_is_stored_is_found,
    claims::the_oldest_is_claimed_first,
    claims::the_highest_priority_is_claimed_first,
    claims::owners_take_turns_whatever_their_priorities,
    claims::the_owner_with_the_fewest_running_is_next,
    claims::an_owner_has_no_more_running_than_allowed,
    claims::the_reserve_takes_small_jobs_only,
    claims::nothing_is_claimed_in_a_pause,
    claims::no_job_is_claimed_twice,
    ends::an_end_is_recorded_once,
    leases::a_beat_renews_the_lease_and_brings_wishes,
    leases::beats_are_answered_in_their_order,
    leases::a_silent_worker_loses_its_job,
    leases::a_former_holder_changes_nothing,
    leases::a_job_that_kills_its_workers_is_parked,
    leases::a_suspect_goes_to_a_free_worker,
    claims::a_job_handed_back_waits_and_counts_no_loss,
    claims::a_retry_does_not_wait_behind_the_backlog,
    leases::all_is_abandoned_at_once,
    ends::a_queued_job_is_cancelled_at_once,
    ends::only_a_failed_job_is_tried_again,
    submissions::the_depth_holds_under_contention,
    submissions::the_quota_holds_under_contention,
    submissions::an_owner_has_no_more_jobs_and_bytes_than_allowed,
    submissions::an_owner_uses_no_more_processor_time_than_allowed,
    submissions::a_key_makes_one_job_under_contention,
    ends::only_ended_jobs_are_deleted,
    ends::what_expired_is_remembered,
    lookups::events_are_those_of_the_records,
    lists::the_list_has_pages_and_no_guests,
    lists::the_list_has_what_is_asked_for,
    lists::jobs_are_found_by_their_metadata,
    lists::jobs_are_found_by_words,
    notices::an_end_is_told_until_it_is_settled,
    notices::every_end_is_told_and_nothing_else,
    notices::a_notice_is_taken_once,
    lookups::equal_jobs_are_those_that_succeeded,
    submissions::an_ended_job_is_stored_however_many_wait,
    owners::each_owner_finds_their_own,
    owners::nobody_changes_what_is_anothers,
    owners::owners_share_no_results_and_no_keys,
    keys::a_key_is_good_until_it_is_revoked,
    keys::keys_that_ended_are_still_there,
    keys::a_page_is_signed_in_no_longer_than_its_key,
    keys::use_is_noted_from_time_to_time,
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
    let use_all = async |key: &str| {
        let key = IdempotencyKey {
            key: key.to_owned(),
            fingerprint: "a mesh".to_owned(),
        };
        let new = job();
        let made = store.enqueue(&new, Some(&key), ROOM).await;
        made.expect("an answer");
        for _ in 0..2 {
            enqueued(&store, &job()).await;
        }
        let claimed = claim(&store).await.expect("it waits");
        let heartbeat = (claimed.id, claimed.token, report(claimed.seq, 0.5));
        store.heartbeat(&[heartbeat]).await.expect("an answer");
        succeed(&store, &claimed).await;
        get(&store, claimed.id).await;
        let listing = Listing {
            limit: 9,
            ..Listing::default()
        };
        store
            .list(&Visibility::All, &listing)
            .await
            .expect("an answer");
        store.equal(&job()).await.expect("an answer");
        store.events(&[claimed.id]).await.expect("an answer");
        claim(&store).await.expect("it waits");
        store.sweep(Sweep::Abandoned).await.expect("an answer");
        claim_soon(&store).await;
        let deleted = store
            .delete(&Visibility::All, claimed.id, Reason::Expired)
            .await;
        assert!(deleted.expect("an answer"));
    };
    use_all("a key").await;
    for table in ["job", "idempotency", "expired", "label"] {
        let newer = format!("ALTER TABLE {table} ADD COLUMN newer BIGINT NOT NULL DEFAULT 0");
        postgres.psql("updated", &newer);
    }
    use_all("another key").await;
}

async fn get(store: &RecordStore, id: JobId) -> Job {
    store
        .get(&Visibility::All, id)
        .await
        .expect("an answer")
        .expect("a job")
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
    let transition = Transition::Ended(job.token, report(job.seq, 0.5), success());
    yes(change(store, job.id, transition).await)
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
