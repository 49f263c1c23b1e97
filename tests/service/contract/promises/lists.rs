//! The list of jobs: its pages, its filters and its order.

use std::sync::Arc;

use unwrapd::jobs::access::{Owner, Visibility};
use unwrapd::jobs::{Job, JobId, JobStore, Listing, Metadata, Order, State, Timestamp, Transition};
use unwrapd::store::RecordStore;
use unwrapd_api::{InputFile, Kind};

use crate::contract::{change, claim, enqueued, job, yes};

async fn listed(store: &RecordStore, visibility: &Visibility, listing: Listing) -> Vec<JobId> {
    let list = store.list(visibility, &listing).await.expect("an answer");
    list.iter().map(|job| job.id).collect()
}

fn all() -> Listing {
    Listing {
        limit: 9,
        ..Listing::default()
    }
}

pub async fn the_list_has_pages_and_no_guests(store: Arc<RecordStore>) {
    let mut ids = Vec::new();
    for ephemeral in [false, true, false, false] {
        let job = Job { ephemeral, ..job() };
        ids.push(enqueued(&store, &job).await.id);
    }
    assert_eq!(store.ephemeral().await.expect("an answer"), [ids[1]]);
    for (order, expected) in [
        (Order::NewestFirst, [ids[3], ids[2], ids[0]]),
        (Order::OldestFirst, [ids[0], ids[2], ids[3]]),
    ] {
        let page = async |after, limit| {
            let listing = Listing {
                order,
                after,
                limit,
                ..Listing::default()
            };
            listed(&store, &Visibility::All, listing).await
        };
        assert_eq!(page(None, 2).await, expected[..2]);
        assert_eq!(page(Some(expected[1]), 2).await, expected[2..]);
        assert!(page(Some(expected[2]), 2).await.is_empty());
    }
}

pub async fn the_list_has_what_is_asked_for(store: Arc<RecordStore>) {
    let alice: Owner = "alice".parse().expect("a name");
    let first = enqueued(&store, &job()).await;
    let second = Job {
        kind: Kind::Measure,
        owner: alice.clone(),
        ..job()
    };
    // A later millisecond by the clock of the store.
    tokio::time::sleep(std::time::Duration::from_millis(20)).await;
    let second = enqueued(&store, &second).await;
    let started = claim(&store).await.expect("it waits").id;
    let list = async |listing| listed(&store, &Visibility::All, listing).await;
    let of_state = |state| Listing {
        state: Some(state),
        ..all()
    };
    assert_eq!(list(of_state(State::Running)).await, [started]);
    assert!(list(of_state(State::Failed)).await.is_empty());
    let of_kind = |kind| Listing {
        kind: Some(kind),
        ..all()
    };
    assert_eq!(list(of_kind(Kind::Measure)).await, [second.id]);
    assert_eq!(list(of_kind(Kind::Unwrap)).await, [first.id]);
    assert!(list(of_kind(Kind::Warp)).await.is_empty());
    let of_owner = |owner: &Owner| Listing {
        owner: Some(owner.clone()),
        ..all()
    };
    assert_eq!(list(of_owner(&alice)).await, [second.id]);
    assert_eq!(list(of_owner(&Owner::anonymous())).await, [first.id]);
    // Nobody sees more by asking for it.
    let others = listed(
        &store,
        &Visibility::Own(Owner::anonymous()),
        of_owner(&alice),
    )
    .await;
    assert!(others.is_empty());
    let within = |since, until| Listing {
        since,
        until,
        ..all()
    };
    assert_eq!(list(within(Some(second.created), None)).await, [second.id]);
    assert_eq!(list(within(None, Some(second.created))).await, [first.id]);
    let later = Some(Timestamp(second.created.0 + 1));
    assert!(list(within(later, None)).await.is_empty());
}

pub async fn jobs_are_found_by_their_metadata(store: Arc<RecordStore>) {
    let metadata = |text: &str| text.parse::<Metadata>().expect("an object");
    let noted = |text| Job {
        metadata: metadata(text),
        ..job()
    };
    let noted_first = noted(r#"{"project": "atlas", "frame": 7, "tags": ["a", "b"]}"#);
    let first = enqueued(&store, &noted_first).await;
    assert_eq!(first.metadata, noted_first.metadata);
    let second = enqueued(&store, &noted(r#"{"project": "atlas", "frame": "7"}"#))
        .await
        .id;
    let third = enqueued(&store, &job()).await;
    let list = async |text| {
        let listing = Listing {
            metadata: metadata(text),
            ..all()
        };
        listed(&store, &Visibility::All, listing).await
    };
    assert_eq!(list(r#"{"project": "atlas"}"#).await, [second, first.id]);
    assert_eq!(list(r#"{"frame": 7}"#).await, [first.id]);
    assert_eq!(
        list(r#"{"tags": ["a", "b"], "project": "atlas"}"#).await,
        [first.id]
    );
    assert!(list(r#"{"project": "atlas", "frame": 8}"#).await.is_empty());
    assert!(list(r#"{"projec": "tatlas"}"#).await.is_empty());
    assert_eq!(list("{}").await, [third.id, second, first.id]);
    // New metadata replaces all of the old, in the record and in the lists.
    let noted = Transition::Noted(metadata(r#"{"frame": 8}"#));
    let changed = yes(change(&store, first.id, noted).await);
    assert_eq!(changed.metadata, metadata(r#"{"frame": 8}"#));
    let read = store.get(&Visibility::All, first.id).await;
    let read = read.expect("an answer").expect("a job");
    assert_eq!(read.metadata, changed.metadata);
    assert_eq!(list(r#"{"frame": 8}"#).await, [first.id]);
    assert!(list(r#"{"frame": 7}"#).await.is_empty());
    assert_eq!(list(r#"{"project": "atlas"}"#).await, [second]);
}

pub async fn jobs_are_found_by_words(store: Arc<RecordStore>) {
    let named = |name: &str, text: &str| Job {
        input: vec![InputFile {
            name: name.to_owned(),
            bytes: 1,
            sha256: None,
        }],
        metadata: text.parse().expect("an object"),
        ..job()
    };
    let mut ids = Vec::new();
    for (name, text) in [
        (
            "Chair.glb",
            r#"{"name": "Élan", "hero": true, "note": "rocks"}"#,
        ),
        (
            "rock.obj",
            r#"{"path": "props/\"Big\"/rock.obj", "hero": false}"#,
        ),
        ("chair_100%.obj", "{}"),
    ] {
        ids.push(enqueued(&store, &named(name, text)).await.id);
    }
    let [chair, rock, percent] = ids[..] else {
        panic!("three jobs");
    };
    let list = async |words: &[&str], limit| {
        let listing = Listing {
            words: words.iter().map(|&word| word.to_owned()).collect(),
            limit,
            ..Listing::default()
        };
        listed(&store, &Visibility::All, listing).await
    };
    assert_eq!(list(&[], 9).await, [percent, rock, chair]);
    assert_eq!(list(&["chair"], 9).await, [percent, chair]);
    assert_eq!(list(&["chair"], 1).await, [percent]);
    assert_eq!(list(&["chair", "hero"], 9).await, [chair]);
    assert_eq!(list(&["élan"], 9).await, [chair]);
    // What is noted otherwise, and a member that is not true, are no words of a job.
    assert!(list(&["rocks"], 9).await.is_empty());
    assert_eq!(list(&["hero"], 9).await, [chair]);
    // Signs stand for themselves.
    assert_eq!(list(&["\"big\"", "rock"], 9).await, [rock]);
    assert_eq!(list(&["0%"], 9).await, [percent]);
    assert_eq!(list(&["r_100"], 9).await, [percent]);
    assert!(list(&["chair__"], 9).await.is_empty());
}
