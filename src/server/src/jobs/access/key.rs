//! Keys: their records, ids and texts, and the store that keeps the records.

use std::fmt::{self, Write as _};
use std::str::FromStr;
use std::time::Duration;

use futures_util::future::BoxFuture;
use subtle::ConstantTimeEq;

use super::owner::{Owner, Scopes};
use crate::jobs::{StoreError, StoreResult, Timestamp};
use unwrapd_api::sha256;

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

// Ids of keys.

/// Number of random bytes in an id. With 64 bits, collisions become likely only among billions of keys.
const ID_BYTES: usize = 8;

/// Id of a key. It is not secret.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct KeyId(String);

/// Error for a text that is not a key id.
#[derive(Debug, thiserror::Error)]
#[error("the id of a key has 16 hexadecimal digits")]
pub struct InvalidKeyId;

impl KeyId {
    /// Returns the id stored in a record, without checking it.
    pub fn recorded(text: String) -> Self {
        Self(text)
    }

    /// Returns the id as records store it.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for KeyId {
    type Err = InvalidKeyId;

    fn from_str(text: &str) -> Result<Self, InvalidKeyId> {
        let id = Some(text).filter(|text| is_id(text));
        id.map(|id| Self(id.to_owned())).ok_or(InvalidKeyId)
    }
}

impl fmt::Display for KeyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Returns whether a text has the form of a key id.
fn is_id(text: &str) -> bool {
    text.len() == 2 * ID_BYTES
        && text
            .bytes()
            .all(|it| matches!(it, b'0'..=b'9' | b'a'..=b'f'))
}

// The text of a key, which only its owner keeps.

/// Prefix of every key, by which people and scanners for leaked secrets recognize it.
const PREFIX: &str = "uw_";
/// Number of random bytes in a secret: 256 bits, so that a digest without salt and stretching suffices.
const SECRET_BYTES: usize = 32;

/// Text of a key: `uw_ID_SECRET`, both parts in hexadecimal digits.
pub struct KeyText {
    id: KeyId,
    secret: String,
}

impl KeyText {
    /// Generates a key from the system's randomness.
    pub fn fresh() -> StoreResult<Self> {
        Ok(Self {
            id: KeyId::recorded(random_hex::<ID_BYTES>()?),
            secret: random_hex::<SECRET_BYTES>()?,
        })
    }

    /// Parses a key; returns `None` if the text does not have the form of one.
    pub fn parse(text: &str) -> Option<Self> {
        let (id, secret) = text.strip_prefix(PREFIX)?.split_once('_')?;
        Some(Self {
            id: id.parse().ok()?,
            secret: secret.to_owned(),
        })
    }

    /// Returns the id of the key, which is not secret.
    pub fn id(&self) -> &KeyId {
        &self.id
    }

    /// Returns the SHA-256 of the secret, which is all that is stored of it.
    pub fn digest(&self) -> String {
        sha256(self.secret.as_bytes())
    }

    /// Returns whether this is the digest of the secret, in constant time.
    pub fn has_digest(&self, digest: &str) -> bool {
        self.digest().as_bytes().ct_eq(digest.as_bytes()).into()
    }

    /// Returns the full text, to be given to its owner.
    pub fn reveal(&self) -> String {
        format!("{PREFIX}{}_{}", self.id, self.secret)
    }
}

/// Omits the secret, which must not reach a log.
impl fmt::Debug for KeyText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{PREFIX}{}_…", self.id)
    }
}

fn random_hex<const N: usize>() -> StoreResult<String> {
    let mut bytes = [0; N];
    let filled = getrandom::fill(&mut bytes);
    filled.map_err(|error| StoreError::Other(format!("no randomness: {error}")))?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}
