//! Scopes of keys.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use serde::Serialize;

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
        let scope = |word: &str| {
            let mut all = Scope::ALL.into_iter();
            all.find(|scope| scope.word() == word.trim())
                .ok_or(InvalidScopes)
        };
        let scopes: BTreeSet<Scope> = text.split(',').map(scope).collect::<Result<_, _>>()?;
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
