//! Keys that come with calls, and whether they are good.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::time::{Instant, sleep};

use super::caller::Caller;
use super::key::{Key, KeyStore, NewKey};
use super::key_id::KeyId;
use super::key_text::KeyText;
use crate::jobs::{StoreError, StoreResult, Timestamp};

/// How long an answer of the store is used again: a revoked key is refused that much later at most.
const FRESH: Duration = Duration::from_secs(2);
/// Between two notes that a key is used.
const NOTED: Duration = Duration::from_hours(1);
/// How long a page stays signed in.
const SIGNED_IN: Duration = Duration::from_hours(12);

/// Why a call is not answered.
#[derive(Debug, thiserror::Error)]
pub enum Denied {
    /// It has no key.
    #[error("a key is needed")]
    NoKey,
    /// Its key is unknown, revoked or expired.
    #[error("the key is not good")]
    BadKey,
    /// The store does not say.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A key that was made for a page.
#[derive(Debug)]
pub struct Signed {
    /// Its text.
    pub text: KeyText,
    /// How long it is good.
    pub life: Duration,
}

/// The keys of a store, as a service asks about them again and again.
pub struct KeyRing {
    store: Arc<dyn KeyStore>,
    known: Mutex<Known>,
}

/// What the store has said.
struct Known {
    /// Whether keys are asked for: that never ends.
    are_required: bool,
    /// When it was last found that they are not.
    are_free: Option<Instant>,
    /// Good keys, and when they were found to be.
    good: HashMap<KeyId, (Key, Instant)>,
}

impl KeyRing {
    /// Asks for keys once there is one.
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

    /// Asks for keys from the start.
    #[must_use]
    pub fn requiring_keys(self) -> Self {
        self.known().are_required = true;
        self
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether a call needs a key.
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

    /// Who calls with this text for a key.
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

    /// The good key of this id.
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
        // Whoever knows no secret cannot fill it: ids that are unknown are not kept.
        known.good.retain(|_, (_, found)| is_fresh(*found));
        if let Some(key) = &key {
            known.good.insert(id.clone(), (key.clone(), asked));
        }
        Ok(key)
    }

    async fn note_use(&self, key: &Key) {
        let ago = |used: Timestamp| u128::from(Timestamp::now().since(used));
        if key.used.is_some_and(|used| ago(used) < NOTED.as_millis()) {
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

    /// Makes a key for a page of a caller; none for a caller without one.
    pub async fn sign_in(&self, caller: &Caller) -> StoreResult<Option<Signed>> {
        let Some(key) = caller.key() else {
            return Ok(None);
        };
        let text = KeyText::fresh()?;
        let parent = match &key.parent {
            Some(parent) => self.good(parent).await?,
            None => Some(key.clone()),
        };
        // It was revoked just now.
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

    /// Ends the key of a page; that of a person stays.
    pub async fn sign_out(&self, caller: &Caller) -> StoreResult<()> {
        if let Some(key) = caller.key().filter(|key| key.parent.is_some()) {
            self.store.revoke(&key.id).await?;
            self.known().good.remove(&key.id);
        }
        Ok(())
    }

    /// Returns when a caller would not be let in any more: what goes on for long ends then.
    pub async fn lapsed(&self, caller: &Caller) {
        loop {
            sleep(FRESH).await;
            let lapsed = match caller.key() {
                Some(key) => self.good(&key.id).await.map(|key| key.is_none()),
                None => self.are_required().await,
            };
            // Whatever the store does not say may still be so.
            if let Ok(true) = lapsed {
                return;
            }
        }
    }
}

fn is_fresh(found: Instant) -> bool {
    found.elapsed() < FRESH
}
