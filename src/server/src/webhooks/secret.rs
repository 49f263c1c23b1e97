//! What deliveries are signed with.

use std::fmt;
use std::str::FromStr;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hmac::{Hmac, Mac};
use sha2::Sha256;

use crate::jobs::access::Owner;

/// Bytes that a secret of a service has at least.
const LEAST: usize = 24;

/// A secret of the service, from which each owner has one of their own: none can sign for another,
/// and nothing has to be kept.
#[derive(Clone)]
pub struct Secret(String);

/// What is no secret.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a secret has at least {LEAST} characters, no space and no comma")]
pub struct SecretError;

/// Secrets that are in force: deliveries are signed with each, so that one can replace another.
#[derive(Clone, Debug)]
pub struct Secrets(Vec<Secret>);

fn hmac(key: &[u8], parts: &[&str]) -> [u8; 32] {
    // A key may have any length.
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

    /// The secret by which an owner checks deliveries, as Standard Webhooks writes it.
    pub fn told_to(&self, owner: &Owner) -> String {
        format!("whsec_{}", STANDARD.encode(self.of_owner(owner)))
    }
}

impl Secrets {
    /// The first: that which is to be told.
    pub fn present(&self) -> Option<&Secret> {
        self.0.first()
    }

    /// The signatures of a delivery to an owner.
    pub(super) fn sign(&self, owner: &Owner, (id, time, body): (&str, i64, &str)) -> String {
        let time = time.to_string();
        let sign = |secret: &Secret| {
            let signed = hmac(&secret.of_owner(owner), &[id, ".", &time, ".", body]);
            format!("v1,{}", STANDARD.encode(signed))
        };
        let signatures: Vec<String> = self.0.iter().map(sign).collect();
        signatures.join(" ")
    }
}

/// Hidden: it may come into a log.
impl fmt::Debug for Secret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("***")
    }
}

impl FromStr for Secrets {
    type Err = SecretError;

    fn from_str(text: &str) -> Result<Self, SecretError> {
        let secret = |text: &str| {
            let is_good = LEAST <= text.len() && text.chars().all(|c| c.is_ascii_graphic());
            is_good.then(|| Secret(text.to_owned())).ok_or(SecretError)
        };
        text.split(',')
            .map(secret)
            .collect::<Result<_, _>>()
            .map(Self)
    }
}
