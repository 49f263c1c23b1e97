//! Secrets for signing deliveries.

use std::fmt;
use std::str::FromStr;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hmac::{Hmac, Mac};
use sha2::Sha256;

use crate::jobs::access::Owner;

/// Minimum length of a secret in bytes, as in Standard Webhooks.
const LEAST: usize = 24;

/// Secret of the service, from which a secret per owner is derived: no owner can sign for another, and nothing has to
/// be stored.
#[derive(Clone)]
pub struct Secret(String);

/// Error for a text that is not a secret.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a secret has at least {LEAST} characters, no space and no comma")]
pub struct SecretError;

/// Secrets in force. Deliveries are signed with each of them, so that one can replace another.
#[derive(Clone, Debug)]
pub struct Secrets(Vec<Secret>);

fn hmac(key: &[u8], parts: &[&str]) -> [u8; 32] {
    // HMAC accepts keys of any length.
    let mut mac = Hmac::<Sha256>::new_from_slice(key).unwrap_or_else(|_| unreachable!());
    for part in parts {
        mac.update(part.as_bytes());
    }
    mac.finalize().into_bytes().into()
}

impl Secret {
    fn of_owner(&self, owner: &Owner) -> [u8; 32] {
        hmac(self.0.as_bytes(), &["unwrapd webhooks of ", owner.as_str()])
    }

    /// Returns the secret with which an owner verifies deliveries, in the format of Standard Webhooks.
    pub fn told_to(&self, owner: &Owner) -> String {
        format!("whsec_{}", STANDARD.encode(self.of_owner(owner)))
    }
}

impl Secrets {
    /// Returns the first secret, from which the owners' secrets are derived when they ask.
    pub fn present(&self) -> Option<&Secret> {
        self.0.first()
    }

    /// Returns the signatures of a delivery to an owner.
    pub(super) fn sign(&self, owner: &Owner, id: &str, time: i64, body: &str) -> String {
        let time = time.to_string();
        let signatures: Vec<String> = (self.0.iter())
            .map(|secret| {
                let signed = hmac(&secret.of_owner(owner), &[id, ".", &time, ".", body]);
                format!("v1,{}", STANDARD.encode(signed))
            })
            .collect();
        signatures.join(" ")
    }
}

/// Omits the secret, which must not reach a log.
impl fmt::Debug for Secret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("***")
    }
}

impl FromStr for Secrets {
    type Err = SecretError;

    fn from_str(text: &str) -> Result<Self, SecretError> {
        let secrets = text.split(',').map(|text| {
            let is_good = LEAST <= text.len() && text.chars().all(|c| c.is_ascii_graphic());
            is_good.then(|| Secret(text.to_owned())).ok_or(SecretError)
        });
        secrets.collect::<Result<_, _>>().map(Self)
    }
}
