//! Key records and the store that keeps them.

use std::time::Duration;

use futures_util::future::BoxFuture;

use super::key_id::KeyId;
use super::owner::Owner;
use super::scope::Scopes;
use crate::jobs::{StoreResult, Timestamp};

/// A key to be recorded.
#[derive(Clone, Debug)]
pub struct NewKey {
    /// Id of the key.
    pub id: KeyId,
    /// SHA-256 of its secret, in hexadecimal digits.
    pub digest: String,
    /// Owner of everything created with it.
    pub owner: Owner,
    /// Scopes that it grants.
    pub scopes: Scopes,
    /// Label for people.
    pub name: String,
    /// Lifetime; `None` if it is valid until it is revoked.
    pub life: Option<Duration>,
    /// Key that signed in with it. It expires no later than that one.
    pub parent: Option<Key>,
}

impl NewKey {
    /// Returns the record of the key if it is created at `now`.
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

/// A recorded key.
#[derive(Clone, Debug)]
pub struct Key {
    /// Id of the key.
    pub id: KeyId,
    /// SHA-256 of its secret, in hexadecimal digits.
    pub digest: String,
    /// Owner of everything created with it.
    pub owner: Owner,
    /// Scopes that it grants.
    pub scopes: Scopes,
    /// Label for people.
    pub name: String,
    /// Id of the key that signed in with it.
    pub parent: Option<KeyId>,
    /// Time of creation.
    pub created: Timestamp,
    /// Time of expiry; `None` if it never expires.
    pub expires: Option<Timestamp>,
    /// Time of revocation.
    pub revoked: Option<Timestamp>,
    /// Time of last use, to the hour.
    pub used: Option<Timestamp>,
}

/// Store of key records. It lies beside the job records, so all processes that share these share the keys. Times are
/// those of the store's clock.
pub trait KeyStore: Send + Sync {
    /// Records a key.
    fn add_key<'a>(&'a self, new: &'a NewKey) -> BoxFuture<'a, StoreResult<Key>>;

    /// Returns whether any key was ever created.
    fn has_keys(&self) -> BoxFuture<'_, StoreResult<bool>>;

    /// Returns all keys ever created, oldest first, without the keys of signed-in pages.
    fn keys(&self) -> BoxFuture<'_, StoreResult<Vec<Key>>>;

    /// Returns a key if neither it nor its parent is revoked or expired.
    fn good_key<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<Option<Key>>>;

    /// Records the use of a key and of its parent, unless a use was recorded within `every`.
    fn note_use<'a>(&'a self, id: &'a KeyId, every: Duration) -> BoxFuture<'a, StoreResult<()>>;

    /// Revokes a key. Returns `false` if there is no such key or it was already revoked.
    fn revoke<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<bool>>;
}
