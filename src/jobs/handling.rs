//! What is said of a job beside what it computes.

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
