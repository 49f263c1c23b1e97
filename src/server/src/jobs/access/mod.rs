//! Access control: owners, keys with scopes, and callers.
//!
//! Every job and every live session has an [`Owner`]. Each lookup takes a [`Visibility`], and anything outside it is
//! reported as missing. A request gets its visibility from its [`Caller`], and the caller from the key in the request, so
//! no lookup can skip the check.
//!
//! The store keeps only the digest of a [`Key`]'s secret. Secrets are 32 random bytes that nobody can guess, so
//! SHA-256 is enough: slow hashes protect passwords that people choose. Once a key exists, the service requires one,
//! even after all keys are revoked or expired. Forgetting to create a new key locks everybody out and lets nobody in.
//!
//! Browsers cannot send a header with a WebSocket or an image. A page signs in instead: it gets a key of its own in a
//! cookie that scripts cannot read. That key expires after some hours, or with the key that created it.

mod key;
mod owner;
mod ring;

pub use key::{Key, KeyId, KeyStore, KeyText, NewKey};
pub use owner::{Owner, Scope, Scopes};
pub use ring::{Caller, Denied, KeyRing, Signed, Visibility};
