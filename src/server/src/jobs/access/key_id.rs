//! What names a key.

use std::fmt;
use std::str::FromStr;

/// Random bytes of an id.
pub(super) const ID_BYTES: usize = 8;

/// Names a key. It is no secret.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct KeyId(String);

/// What is no id of a key.
#[derive(Debug, thiserror::Error)]
#[error("the id of a key has 16 hexadecimal digits")]
pub struct InvalidKeyId;

impl KeyId {
    /// The id that a record has.
    pub fn recorded(text: String) -> Self {
        Self(text)
    }

    /// The id as records have it.
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

/// Whether a text is the id of a key.
fn is_id(text: &str) -> bool {
    let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
    text.len() == 2 * ID_BYTES && text.bytes().all(is_digit)
}
