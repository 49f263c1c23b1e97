//! Keys as they are recorded.

use std::time::Duration;

use futures_util::future::BoxFuture;

use super::key_id::KeyId;
use super::owner::Owner;
use super::scope::Scopes;
use crate::jobs::{StoreResult, Timestamp};

/// A key that is to be recorded.
#[derive(Clone, Debug)]
pub struct NewKey {
    /// Names it.
    pub id: KeyId,
    /// SHA-256 of its secret, in hexadecimal digits.
    pub digest: String,
    /// Whose what is made with it is.
    pub owner: Owner,
    /// What it is good for.
    pub scopes: Scopes,
    /// What people call it.
    pub name: String,
    /// How long it is good; none: until it is revoked.
    pub life: Option<Duration>,
    /// The key that signed in with it. It is good no longer than that one.
    pub parent: Option<Key>,
}

impl NewKey {
    /// The key as it is recorded at a time.
    pub fn recorded(&self, now: Timestamp) -> Key {
        let parent = self.parent.as_ref();
        let ends = [
            self.life.map(|life| now.later(life)),
            parent.and_then(|parent| parent.expires),
        ];
        Key {
            id: self.id.clone(),
            digest: self.digest.clone(),
            owner: self.owner.clone(),
            scopes: self.scopes.clone(),
            name: self.name.clone(),
            parent: parent.map(|parent| parent.id.clone()),
            created: now,
            expires: ends.into_iter().flatten().min(),
            revoked: None,
            used: None,
        }
    }
}

/// A key as it is recorded.
#[derive(Clone, Debug)]
pub struct Key {
    /// Names it.
    pub id: KeyId,
    /// SHA-256 of its secret, in hexadecimal digits.
    pub digest: String,
    /// Whose what is made with it is.
    pub owner: Owner,
    /// What it is good for.
    pub scopes: Scopes,
    /// What people call it.
    pub name: String,
    /// The key that signed in with it.
    pub parent: Option<KeyId>,
    /// When it was made.
    pub created: Timestamp,
    /// When it is good no longer.
    pub expires: Option<Timestamp>,
    /// When it was revoked.
    pub revoked: Option<Timestamp>,
    /// When it was used last, to the hour.
    pub used: Option<Timestamp>,
}

/// Records of keys, in one place with those of jobs, so that all processes that share these share
/// them. Times are those of the store's own clock.
pub trait KeyStore: Send + Sync {
    /// Records a key.
    fn add_key<'a>(&'a self, new: &'a NewKey) -> BoxFuture<'a, StoreResult<Key>>;

    /// Whether a key was ever made.
    fn has_keys(&self) -> BoxFuture<'_, StoreResult<bool>>;

    /// The keys that were ever made, the oldest first, without those of pages that signed in.
    fn keys(&self) -> BoxFuture<'_, StoreResult<Vec<Key>>>;

    /// A key that is neither revoked nor expired, and nor is the one that signed in with it.
    fn good_key<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<Option<Key>>>;

    /// Notes that a key is used, and the one that signed in with it, unless that was noted within
    /// this time.
    fn note_use<'a>(&'a self, id: &'a KeyId, every: Duration) -> BoxFuture<'a, StoreResult<()>>;

    /// Revokes a key; false if there is none that is not revoked.
    fn revoke<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<bool>>;
}
