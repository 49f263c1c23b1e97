//! Webhooks: the end of a job is posted to an address given by its client.
//!
//! Deliveries follow Standard Webhooks: an id that is the same in every retry, the time, and an HMAC-SHA256 signature
//! over both and the body. A notice is recorded together with the end of its job and stays in the store until the
//! receiver answers 2xx or the retries are used up. So no crash loses a notice, but one may be delivered twice.
//!
//! Clients choose the address, and must not be able to reach internal addresses through the service. So names are
//! resolved here, and connections go only to the addresses that were checked ([`is_public`]). Redirects are not
//! followed, and no proxy is used.

mod delivery;
mod guard;
mod secret;

pub use delivery::{DeliverySettings, deliver};
pub use guard::{Reachable, check, is_public};
pub use secret::{Secret, SecretError, Secrets};
