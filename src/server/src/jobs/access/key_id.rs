//! Ids of keys.

use std::fmt;
use std::str::FromStr;

/// Number of random bytes in an id. With 64 bits, collisions become likely only among billions of keys.
pub(super) const ID_BYTES: usize = 8;

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
    let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
    text.len() == 2 * ID_BYTES && text.bytes().all(is_digit)
}
