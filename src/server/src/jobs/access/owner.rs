//! Owners of jobs and sessions, and the scopes of their keys.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use serde::Serialize;

/// Maximum length of a name in characters, by convention. The name is stored with every job.
const MOST: usize = 64;

/// Owner of a job or a session. Anything created without a key belongs to the anonymous owner.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Owner(String);

/// Error for a text that is not the name of an owner.
#[derive(Debug, thiserror::Error)]
#[error("a name has 1 to {MOST} characters: letters, digits and any of . _ @ + -")]
pub struct InvalidOwner;

impl Owner {
    /// Returns the owner of everything created without a key.
    pub fn anonymous() -> Self {
        Self::default()
    }

    /// Returns the owner named by a record, without checking the name.
    pub fn recorded(text: String) -> Self {
        Self(text)
    }

    /// Returns the name as records store it; it is empty for the anonymous owner.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Returns the name; `None` for the anonymous owner.
    pub fn name(&self) -> Option<&str> {
        Some(self.as_str()).filter(|name| !name.is_empty())
    }
}

impl FromStr for Owner {
    type Err = InvalidOwner;

    fn from_str(text: &str) -> Result<Self, InvalidOwner> {
        let is_plain = (text.chars()).all(|c| c.is_ascii_alphanumeric() || "._@+-".contains(c));
        if is_plain && (1..=MOST).contains(&text.len()) {
            Ok(Self(text.to_owned()))
        } else {
            Err(InvalidOwner)
        }
    }
}

// Scopes of keys.

/// Permission of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// Look at jobs and sessions, and fetch files.
    Read,
    /// Make, change and remove them.
    Write,
    /// Do so with those of all owners, and with the service itself.
    Admin,
}

impl Scope {
    const ALL: [Self; 3] = [Self::Read, Self::Write, Self::Admin];

    /// Returns the scope's name on the command line and in the API.
    pub fn word(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Write => "write",
            Self::Admin => "admin",
        }
    }
}

/// A set of scopes. Its text form is a comma-separated list of names; `admin` alone stands for all scopes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Scopes(BTreeSet<Scope>);

/// Error for a text that is not a set of scopes.
#[derive(Debug, thiserror::Error)]
#[error("expected some of read, write and admin, with commas between")]
pub struct InvalidScopes;

impl Scopes {
    /// Returns all scopes.
    pub fn all() -> Self {
        Self(Scope::ALL.into())
    }

    /// Returns whether the set contains a scope.
    pub fn have(&self, scope: Scope) -> bool {
        self.0.contains(&scope)
    }
}

impl FromStr for Scopes {
    type Err = InvalidScopes;

    fn from_str(text: &str) -> Result<Self, InvalidScopes> {
        let mut scopes = BTreeSet::new();
        for word in text.split(',') {
            let scope = (Scope::ALL.into_iter()).find(|scope| scope.word() == word.trim());
            scopes.insert(scope.ok_or(InvalidScopes)?);
        }
        // Alone, `admin` would permit nothing: it extends the other scopes to all owners.
        if scopes == BTreeSet::from([Scope::Admin]) {
            return Ok(Self::all());
        }
        Ok(Self(scopes))
    }
}

impl fmt::Display for Scopes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<&str> = self.0.iter().map(|scope| scope.word()).collect();
        f.write_str(&words.join(","))
    }
}
