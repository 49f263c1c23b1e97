//! Keys of the API.

use std::sync::Arc;
use std::time::Duration;

use unwrapd::jobs::access::{Key, KeyStore, KeyText, NewKey};
use unwrapd::store::RecordStore;

const HOUR: Duration = Duration::from_hours(1);

/// A key that nobody has recorded.
fn new(life: Option<Duration>, parent: Option<&Key>) -> NewKey {
    let text = KeyText::fresh().expect("randomness");
    NewKey {
        id: text.id().clone(),
        digest: text.digest(),
        owner: "alice".parse().expect("a name"),
        scopes: "read,write".parse().expect("scopes"),
        name: "for tests".to_owned(),
        life,
        parent: parent.cloned(),
    }
}

async fn added(store: &RecordStore, new: &NewKey) -> Key {
    store.add_key(new).await.expect("an answer")
}

async fn good(store: &RecordStore, key: &Key) -> Option<Key> {
    store.good_key(&key.id).await.expect("an answer")
}

pub async fn a_key_is_good_until_it_is_revoked(store: Arc<RecordStore>) {
    assert!(!store.has_keys().await.expect("an answer"));
    let [one, other] = [new(None, None), new(Some(HOUR), None)];
    let one = added(&store, &one).await;
    let other = added(&store, &other).await;
    assert_eq!(
        other.expires.expect("an end").since(other.created),
        3_600_000
    );
    for key in [&one, &other] {
        let found = good(&store, key).await.expect("it is good");
        assert_eq!(format!("{found:?}"), format!("{key:?}"));
    }
    assert!(store.revoke(&one.id).await.expect("an answer"));
    assert!(good(&store, &one).await.is_none());
    assert!(!store.revoke(&one.id).await.expect("an answer"));
    let unknown = new(None, None).id;
    assert!(!store.revoke(&unknown).await.expect("an answer"));
    let all = store.keys().await.expect("an answer");
    let of = |key: &Key| (key.id.to_string(), key.revoked.is_some());
    let mut found: Vec<_> = all.iter().map(of).collect();
    let mut expected = [(one.id.to_string(), true), (other.id.to_string(), false)];
    // Of one millisecond either may be the first.
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}

/// Without good keys nobody gets in, rather than everybody.
pub async fn keys_that_ended_are_still_there(store: Arc<RecordStore>) {
    let key = added(&store, &new(Some(Duration::from_millis(100)), None)).await;
    while good(&store, &key).await.is_some() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    assert!(store.has_keys().await.expect("an answer"));
    assert_eq!(store.keys().await.expect("an answer").len(), 1);
}

pub async fn a_page_is_signed_in_no_longer_than_its_key(store: Arc<RecordStore>) {
    let parent = added(&store, &new(Some(HOUR), None)).await;
    let long = added(&store, &new(Some(2 * HOUR), Some(&parent))).await;
    assert_eq!(long.expires, parent.expires);
    let short = added(&store, &new(Some(HOUR / 2), Some(&parent))).await;
    assert!(short.expires < parent.expires);
    assert!(good(&store, &long).await.is_some());
    assert_eq!(store.keys().await.expect("an answer").len(), 1);

    assert!(store.revoke(&short.id).await.expect("an answer"));
    assert!(good(&store, &long).await.is_some());
    assert!(good(&store, &parent).await.is_some());
    assert!(store.revoke(&parent.id).await.expect("an answer"));
    assert!(good(&store, &long).await.is_none());
}

pub async fn use_is_noted_from_time_to_time(store: Arc<RecordStore>) {
    let parent = added(&store, &new(None, None)).await;
    let page = added(&store, &new(None, Some(&parent))).await;
    let idle = added(&store, &new(None, None)).await;
    let note = async |every| {
        store.note_use(&page.id, every).await.expect("an answer");
        let used = async |key| good(&store, key).await.expect("it is good").used;
        [used(&page).await, used(&parent).await, used(&idle).await]
    };
    let first = note(HOUR).await;
    assert!(first[0].is_some() && first[1].is_some() && first[2].is_none());
    assert_eq!(note(HOUR).await, first);
    tokio::time::sleep(Duration::from_millis(5)).await;
    let later = note(Duration::ZERO).await;
    assert!(first[0] < later[0] && first[1] < later[1], "{later:?}");
}
