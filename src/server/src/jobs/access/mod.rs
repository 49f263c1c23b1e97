//! Who may do what: owners, keys with scopes, and the calls that come with them.
//!
//! Every job and every live session has an [`Owner`]. Whoever looks for one says how far they see, their
//! [`Reach`], and what lies beyond it does not exist for them. A call gets its reach from its
//! [`Caller`], and that from the key that it carries, so none can be looked for without.
//!
//! A [`Key`] is kept as the digest of its secret. Secrets are 32 random bytes that nobody can guess,
//! so that SHA-256 is enough: a slow hash protects words that people choose. Once a key was made, a
//! service asks for one, even after all are revoked or have expired: forgetting to make a new one
//! locks everybody out and lets nobody in.
//!
//! Browsers cannot send a header with a WebSocket or a picture. A page signs in instead: it gets a key
//! made for it, in a cookie that no script reads, which ends after some hours or with the key that
//! made it.

mod caller;
mod key;
mod key_id;
mod key_text;
mod owner;
mod ring;
mod scope;

pub use caller::{Caller, Reach};
pub use key::{Key, KeyStore, NewKey};
pub use key_id::KeyId;
pub use key_text::KeyText;
pub use owner::Owner;
pub use ring::{Denied, KeyRing, Signed};
pub use scope::{Scope, Scopes};
