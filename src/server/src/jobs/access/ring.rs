//! Callers, and the authentication of requests by key with a short-lived cache.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::time::{Instant, sleep};

use super::key::{Key, KeyId, KeyStore, KeyText, NewKey};
use super::owner::{Owner, Scope, Scopes};
use crate::jobs::{StoreError, StoreResult, Timestamp};

/// Time for which an answer of the store is cached. A revoked key is accepted for at most that long, as the help of
/// `unwrapd keys revoke` promises; a shorter time queries the store more often.
const FRESH: Duration = Duration::from_secs(2);
/// Minimum time between two records of a key's use. Each record is a write, and an hour is precise enough to find
/// keys that nobody uses.
const NOTED: Duration = Duration::from_hours(1);
/// Lifetime of a page's sign-in. A longer one keeps a stolen cookie valid for longer; a shorter one asks for the key
/// more often.
const SIGNED_IN: Duration = Duration::from_hours(12);

/// Reason for rejecting a request.
#[derive(Debug, thiserror::Error)]
pub enum Denied {
    /// The request has no key.
    #[error("a key is needed")]
    NoKey,
    /// The key is unknown, revoked or expired.
    #[error("the key is not good")]
    BadKey,
    /// The store cannot be read.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A key created for a page that signed in.
#[derive(Debug)]
pub struct Signed {
    /// Text of the key.
    pub text: KeyText,
    /// Lifetime of the key.
    pub life: Duration,
}

/// Cached view of the keys of a store.
pub struct KeyRing {
    store: Arc<dyn KeyStore>,
    known: Mutex<Known>,
}

/// Cached answers of the store.
struct Known {
    /// Set once keys are required; never reset.
    are_required: bool,
    /// Time at which keys were last found not to be required.
    are_free: Option<Instant>,
    /// Valid keys, each with the time of its lookup.
    good: HashMap<KeyId, (Key, Instant)>,
}

impl KeyRing {
    /// Creates a key ring that requires keys once the store has one.
    pub fn new(store: Arc<dyn KeyStore>) -> Self {
        let known = Known {
            are_required: false,
            are_free: None,
            good: HashMap::new(),
        };
        Self {
            store,
            known: known.into(),
        }
    }

    /// Requires keys from the start.
    #[must_use]
    pub fn requiring_keys(self) -> Self {
        self.known().are_required = true;
        self
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns whether requests need a key.
    pub async fn are_required(&self) -> StoreResult<bool> {
        {
            let known = self.known();
            if known.are_required || known.are_free.is_some_and(is_fresh) {
                return Ok(known.are_required);
            }
        }
        let asked = Instant::now();
        let are_required = self.store.has_keys().await?;
        let mut known = self.known();
        known.are_required |= are_required;
        known.are_free = Some(asked);
        Ok(known.are_required)
    }

    /// Authenticates a request by the text of its key.
    pub async fn caller(&self, text: Option<&str>) -> Result<Caller, Denied> {
        if !self.are_required().await? {
            return Ok(Caller::anonymous());
        }
        let text = KeyText::parse(text.ok_or(Denied::NoKey)?).ok_or(Denied::BadKey)?;
        let key = self.good(text.id()).await?.ok_or(Denied::BadKey)?;
        if !text.has_digest(&key.digest) {
            return Err(Denied::BadKey);
        }
        self.note_use(&key).await;
        Ok(Caller::of(key))
    }

    /// Returns the key with this id if it is valid; asks the store unless the cached answer is fresh.
    async fn good(&self, id: &KeyId) -> StoreResult<Option<Key>> {
        let known = self.known().good.get(id).cloned();
        if let Some((key, found)) = known
            && is_fresh(found)
        {
            return Ok(Some(key));
        }
        let asked = Instant::now();
        let key = self.store.good_key(id).await?;
        let mut known = self.known();
        // Unknown ids are not cached, so callers without a key cannot fill the cache.
        known.good.retain(|_, (_, found)| is_fresh(*found));
        if let Some(key) = &key {
            known.good.insert(id.clone(), (key.clone(), asked));
        }
        Ok(key)
    }

    async fn note_use(&self, key: &Key) {
        if let Some(used) = key.used
            && u128::from(Timestamp::now().since(used)) < NOTED.as_millis()
        {
            return;
        }
        match self.store.note_use(&key.id, NOTED).await {
            Ok(()) => {
                if let Some((key, _)) = self.known().good.get_mut(&key.id) {
                    key.used = Some(Timestamp::now());
                }
            }
            Err(error) => tracing::warn!(key = %key.id, %error, "use not noted"),
        }
    }

    /// Creates a key for a page of the caller. Returns `None` if the caller has no key, or if it was just revoked.
    pub async fn sign_in(&self, caller: &Caller) -> StoreResult<Option<Signed>> {
        let Some(key) = caller.key() else {
            return Ok(None);
        };
        let text = KeyText::fresh()?;
        let parent = match &key.parent {
            Some(parent) => self.good(parent).await?,
            None => Some(key.clone()),
        };
        // The parent was revoked since the request was authenticated.
        let Some(parent) = parent else {
            return Ok(None);
        };
        let new = NewKey {
            id: text.id().clone(),
            digest: text.digest(),
            owner: key.owner.clone(),
            scopes: key.scopes.clone(),
            name: key.name.clone(),
            life: Some(SIGNED_IN),
            parent: Some(parent),
        };
        let made = self.store.add_key(&new).await?;
        let end = made.expires.unwrap_or(made.created);
        let life = Duration::from_millis(end.since(made.created));
        Ok(Some(Signed { text, life }))
    }

    /// Revokes the key of a signed-in page. A key of a person stays valid.
    pub async fn sign_out(&self, caller: &Caller) -> StoreResult<()> {
        if let Some(key) = caller.key().filter(|key| key.parent.is_some()) {
            self.store.revoke(&key.id).await?;
            self.known().good.remove(&key.id);
        }
        Ok(())
    }

    /// Waits until the caller would no longer be let in, so that long-running responses can end.
    pub async fn lapsed(&self, caller: &Caller) {
        loop {
            sleep(FRESH).await;
            let lapsed = match caller.key() {
                Some(key) => self.good(&key.id).await.map(|key| key.is_none()),
                None => self.are_required().await,
            };
            // An error of the store is no revocation.
            if let Ok(true) = lapsed {
                return;
            }
        }
    }
}

fn is_fresh(found: Instant) -> bool {
    found.elapsed() < FRESH
}

// The identity and the permissions behind a request.

/// Visibility of jobs and sessions. Anything outside it is reported as missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// Only jobs and sessions of this owner.
    Own(Owner),
    /// Everything.
    All,
}

impl Visibility {
    /// Returns whether something of this owner is visible.
    pub fn covers(&self, owner: &Owner) -> bool {
        match self {
            Self::Own(own) => own == owner,
            Self::All => true,
        }
    }
}

/// An authenticated caller with its scopes.
#[derive(Clone, Debug)]
pub struct Caller {
    owner: Owner,
    scopes: Scopes,
    /// Key of the request; `None` if the service requires no keys.
    pub(super) key: Option<Key>,
}

impl Caller {
    /// Returns the caller of a service that requires no keys; it has every scope.
    pub fn anonymous() -> Self {
        Self {
            owner: Owner::anonymous(),
            scopes: Scopes::all(),
            key: None,
        }
    }

    /// Returns the caller that holds this key.
    pub(super) fn of(key: Key) -> Self {
        Self {
            owner: key.owner.clone(),
            scopes: key.scopes.clone(),
            key: Some(key),
        }
    }

    /// Returns the owner of everything that the caller creates.
    pub fn owner(&self) -> &Owner {
        &self.owner
    }

    /// Returns the scopes of the caller.
    pub fn scopes(&self) -> &Scopes {
        &self.scopes
    }

    /// Returns the visibility of the caller: everything with the `admin` scope, otherwise its own.
    pub fn visibility(&self) -> Visibility {
        if self.scopes.have(Scope::Admin) {
            Visibility::All
        } else {
            Visibility::Own(self.owner.clone())
        }
    }

    /// Returns the key of the caller; `None` if the service requires no keys.
    pub fn key(&self) -> Option<&Key> {
        self.key.as_ref()
    }
}
