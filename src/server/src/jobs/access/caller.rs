//! Who asks.

use super::key::Key;
use super::owner::Owner;
use super::scope::{Scope, Scopes};

/// How far somebody sees. What lies beyond does not exist for them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reach {
    /// What belongs to this owner.
    Own(Owner),
    /// Everything.
    All,
}

impl Reach {
    /// Whether what belongs to this owner is seen.
    pub fn covers(&self, owner: &Owner) -> bool {
        match self {
            Self::Own(own) => own == owner,
            Self::All => true,
        }
    }
}

/// Who asks, and what they may.
#[derive(Clone, Debug)]
pub struct Caller {
    owner: Owner,
    scopes: Scopes,
    /// The key that came; none where none is asked for.
    pub(super) key: Option<Key>,
}

impl Caller {
    /// Anybody, where no key is asked for: they may do everything.
    pub fn anonymous() -> Self {
        Self {
            owner: Owner::anonymous(),
            scopes: Scopes::all(),
            key: None,
        }
    }

    /// Whoever has this key.
    pub(super) fn of(key: Key) -> Self {
        Self {
            owner: key.owner.clone(),
            scopes: key.scopes.clone(),
            key: Some(key),
        }
    }

    /// Whose what they make is.
    pub fn owner(&self) -> &Owner {
        &self.owner
    }

    /// What they may do.
    pub fn scopes(&self) -> &Scopes {
        &self.scopes
    }

    /// How far they see.
    pub fn reach(&self) -> Reach {
        if self.scopes.have(Scope::Admin) {
            Reach::All
        } else {
            Reach::Own(self.owner.clone())
        }
    }

    /// Their key.
    pub fn key(&self) -> Option<&Key> {
        self.key.as_ref()
    }
}
