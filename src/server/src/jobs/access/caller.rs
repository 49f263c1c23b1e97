//! The identity and the permissions behind a request.

use super::key::Key;
use super::owner::Owner;
use super::scope::{Scope, Scopes};

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
