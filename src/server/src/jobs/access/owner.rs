//! Owners of jobs and sessions.

use std::str::FromStr;

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
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "._@+-".contains(c);
        if (1..=MOST).contains(&text.len()) && text.chars().all(is_plain) {
            Ok(Self(text.to_owned()))
        } else {
            Err(InvalidOwner)
        }
    }
}
