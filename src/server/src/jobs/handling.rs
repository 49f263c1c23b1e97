//! What is said of a job beside what it computes.

use super::digest::Digest;
use super::gates::Gates;
use super::metadata::Metadata;
use super::webhook::Webhook;

/// How a job is handled; equal jobs may be handled differently.
#[derive(Clone, Debug, Default)]
pub struct Handling {
    /// Of the waiting jobs of one owner, those of higher priority start first.
    pub priority: i32,
    /// What the client notes of it.
    pub metadata: Metadata,
    /// What its result has to be.
    pub accept: Option<Gates>,
    /// Where its end is told.
    pub webhook: Option<Webhook>,
}

impl Handling {
    /// What a repetition under one key must agree in: what is asked for, of which this is the digest, and what is said of it. The
    /// priority may differ.
    pub fn fingerprint(&self, digest: &str) -> String {
        let Self {
            metadata,
            accept,
            webhook,
            ..
        } = self;
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
