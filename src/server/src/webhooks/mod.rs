//! Webhooks: the end of a job is posted to an address that its client gave.
//!
//! Deliveries follow Standard Webhooks: an id that repetitions share, the time, and an HMAC-SHA256
//! signature over both and the body. A notice is recorded with the end of its job and stays in the
//! store until somebody answers 2xx, so that no crash loses one; it may be told twice.
//!
//! Whoever submits a job chooses an address, and must not reach through the service what only the
//! service reaches. So a name is resolved here, and connections go to the addresses that were
//! judged and to no others ([`is_public`]); redirections are not followed, nor is a proxy used.

mod address;
mod delivery;
mod guard;
mod secret;

pub use address::is_public;
pub use delivery::{Settings, deliver};
pub use guard::{Reachable, check};
pub use secret::{Secret, SecretError, Secrets};
