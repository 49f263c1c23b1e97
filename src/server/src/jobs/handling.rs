//! Client settings of a job beside what it computes.

use super::digest::Digest;
use super::gates::Gates;
use super::metadata::Metadata;
use super::webhook::Webhook;

/// Handling of a job; jobs that compute the same may be handled differently.
#[derive(Clone, Debug, Default)]
pub struct Handling {
    /// Priority: of an owner's waiting jobs, those with a higher one start first.
    pub priority: i32,
    /// Notes of the client.
    pub metadata: Metadata,
    /// Gates that the result has to pass.
    pub accept: Option<Gates>,
    /// Webhook that is told of the end.
    pub webhook: Option<Webhook>,
}

impl Handling {
    /// Returns the digest of everything that a request with the same idempotency key must repeat. `digest` is that of
    /// its computation. The priority may differ.
    pub fn fingerprint(&self, digest: &str) -> String {
        let Self {
            metadata,
            accept,
            webhook,
            ..
        } = self;
        // Without settings the fingerprint is the digest alone, as in earlier versions, so that stored keys stay valid.
        if metadata.is_empty() && accept.is_none() && webhook.is_none() {
            return digest.to_owned();
        }
        let mut all = Digest::default();
        all.add(digest.as_bytes());
        for label in metadata.labels() {
            all.add(label.as_bytes());
        }
        let accept = accept.as_ref().map(ToString::to_string);
        let webhook = webhook.as_ref().map(ToString::to_string);
        for said in [accept, webhook] {
            all.add(said.unwrap_or_default().as_bytes());
        }
        all.finish()
    }
}
