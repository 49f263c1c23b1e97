//! Whose jobs are: what belongs to one owner does not exist for another.

use std::sync::Arc;

use unwrapd::jobs::access::{Owner, Visibility};
use unwrapd::jobs::{
    Changed, Command, Enqueued, IdempotencyKey, Job, JobId, JobStore, Listing, Reason, Transition,
};
use unwrapd::store::RecordStore;

use super::succeed;
use crate::contract::{ROOM, claim, enqueued, job};

fn owner(name: &str) -> Owner {
    name.parse().expect("a name")
}

fn job_of(owner: &Owner) -> Job {
    Job {
        owner: owner.clone(),
        ..job()
    }
}

/// Three owners, each with a job: two with names, and the anonymous one.
async fn owners(store: &RecordStore) -> [(Visibility, JobId); 3] {
    let mut all = Vec::new();
    for owner in [owner("alice"), owner("bob"), Owner::anonymous()] {
        let id = enqueued(store, &job_of(&owner)).await.id;
        all.push((Visibility::Own(owner), id));
    }
    all.try_into().expect("three")
}

pub async fn each_owner_finds_their_own(store: Arc<RecordStore>) {
    let owners = owners(&store).await;
    let list = async |visibility| {
        let listing = Listing {
            limit: 9,
            ..Listing::default()
        };
        let list = store.list(visibility, &listing).await.expect("an answer");
        list.iter().map(|job| job.id).collect::<Vec<_>>()
    };
    for (visibility, own) in &owners {
        for (_, id) in &owners {
            let found = store.get(visibility, *id).await.expect("an answer");
            assert_eq!(found.is_some(), id == own);
        }
        assert_eq!(list(visibility).await, [*own]);
    }
    let newest_first: Vec<JobId> = owners.iter().rev().map(|(_, id)| *id).collect();
    assert_eq!(list(&Visibility::All).await, newest_first);
}

pub async fn nobody_changes_what_is_anothers(store: Arc<RecordStore>) {
    let [(alice, id), (bob, _), (anonymous, _)] = owners(&store).await;
    for command in [Command::FinishEarly, Command::Cancel, Command::Retry] {
        for visibility in [&bob, &anonymous] {
            let changed = store
                .change(visibility, id, &Transition::Commanded(command))
                .await;
            assert!(matches!(changed, Ok(Changed::Missing)), "{changed:?}");
        }
    }
    let cancel = Transition::Commanded(Command::Cancel);
    let changed = store.change(&alice, id, &cancel).await;
    assert!(matches!(changed, Ok(Changed::Yes(_))), "{changed:?}");
    let delete = async |visibility, reason| {
        let deleted = store.delete(visibility, id, reason).await;
        deleted.expect("an answer")
    };
    assert!(!delete(&bob, Reason::Deleted).await);
    assert!(!delete(&anonymous, Reason::Deleted).await);
    assert!(delete(&alice, Reason::Expired).await);
    let expired = async |visibility| store.has_expired(visibility, id).await.expect("an answer");
    assert!(expired(&alice).await && expired(&Visibility::All).await);
    assert!(!expired(&bob).await && !expired(&anonymous).await);
}

/// Nor does an owner get their results, or meet their keys.
pub async fn owners_share_no_results_and_no_keys(store: Arc<RecordStore>) {
    let [alice, bob] = ["alice", "bob"].map(owner);
    enqueued(&store, &job_of(&alice)).await;
    let done = claim(&store).await.expect("it waits");
    assert_eq!(done.owner, alice);
    succeed(&store, &done).await;
    let equal = async |owner| {
        let equal = store.equal(&job_of(owner)).await.expect("an answer");
        equal.len()
    };
    assert_eq!((equal(&alice).await, equal(&bob).await), (1, 0));
    assert_eq!(equal(&Owner::anonymous()).await, 0);

    let submit = async |owner, key: &str| {
        let key = IdempotencyKey {
            key: key.to_owned(),
            fingerprint: "a mesh".to_owned(),
        };
        let job = job_of(owner);
        let enqueued = store.enqueue(&job, Some(&key), ROOM).await;
        match enqueued.expect("an answer") {
            Enqueued::New(job) | Enqueued::Replay(job) => job.owner,
            other => panic!("{other:?}"),
        }
    };
    let anonymous = Owner::anonymous();
    for owner in [&alice, &bob, &anonymous, &alice, &bob, &anonymous] {
        assert_eq!(submit(owner, "night-run").await, *owner);
    }
    let counts = store.queue().await.expect("an answer").counts;
    assert_eq!(counts[0].1, 3, "each owner has made one job");
}
