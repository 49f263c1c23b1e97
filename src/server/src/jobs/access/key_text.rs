//! The text of a key, which only its owner keeps.

use std::fmt;
use std::fmt::Write as _;

use subtle::ConstantTimeEq;

use super::key_id::{ID_BYTES, KeyId};
use crate::jobs::{StoreError, StoreResult};
use unwrapd_api::sha256;

/// Prefix of every key, by which people and scanners for leaked secrets recognize it.
const PREFIX: &str = "uw_";
/// Number of random bytes in a secret: 256 bits, so that a digest without salt and stretching suffices.
const SECRET_BYTES: usize = 32;

/// Text of a key: `uw_ID_SECRET`, both parts in hexadecimal digits.
pub struct KeyText {
    id: KeyId,
    secret: String,
}

impl KeyText {
    /// Generates a key from the system's randomness.
    pub fn fresh() -> StoreResult<Self> {
        Ok(Self {
            id: KeyId::recorded(random_hex::<ID_BYTES>()?),
            secret: random_hex::<SECRET_BYTES>()?,
        })
    }

    /// Parses a key; returns `None` if the text does not have the form of one.
    pub fn parse(text: &str) -> Option<Self> {
        let (id, secret) = text.strip_prefix(PREFIX)?.split_once('_')?;
        Some(Self {
            id: id.parse().ok()?,
            secret: secret.to_owned(),
        })
    }

    /// Returns the id of the key, which is not secret.
    pub fn id(&self) -> &KeyId {
        &self.id
    }

    /// Returns the SHA-256 of the secret, which is all that is stored of it.
    pub fn digest(&self) -> String {
        sha256(self.secret.as_bytes())
    }

    /// Returns whether this is the digest of the secret, in constant time.
    pub fn has_digest(&self, digest: &str) -> bool {
        self.digest().as_bytes().ct_eq(digest.as_bytes()).into()
    }

    /// Returns the full text, to be given to its owner.
    pub fn reveal(&self) -> String {
        format!("{PREFIX}{}_{}", self.id, self.secret)
    }
}

/// Omits the secret, which must not reach a log.
impl fmt::Debug for KeyText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{PREFIX}{}_…", self.id)
    }
}

fn random_hex<const N: usize>() -> StoreResult<String> {
    let mut bytes = [0; N];
    let filled = getrandom::fill(&mut bytes);
    filled.map_err(|error| StoreError::Other(format!("no randomness: {error}")))?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}
