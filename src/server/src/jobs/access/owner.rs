//! Whose something is.

use std::str::FromStr;

/// Characters of a name at most.
const MOST: usize = 64;

/// Whose a job or a session is. What is made without a key is the anonymous owner's.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Owner(String);

/// What is no name of an owner.
#[derive(Debug, thiserror::Error)]
#[error("a name has 1 to {MOST} characters: letters, digits and any of . _ @ + -")]
pub struct InvalidOwner;

impl Owner {
    /// The owner of what is made without a key.
    pub fn anonymous() -> Self {
        Self::default()
    }

    /// The owner that a record names.
    pub fn recorded(text: String) -> Self {
        Self(text)
    }

    /// The name as records have it, which is empty for the anonymous one.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The name, if there is one.
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
