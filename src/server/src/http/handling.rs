//! Handling settings of an upload, from the query or from form parts.

use std::ops::RangeInclusive;

use super::problem::{Code, Problem};
use crate::jobs::{GateError, Gates, Handling, Metadata, Webhook};
use unwrapd_api::Kind;

/// Permitted priorities. The OpenAPI document repeats the bounds.
const PRIORITIES: RangeInclusive<i32> = -100..=100;

/// Settings received so far.
#[derive(Default)]
pub(super) struct HandlingBuilder {
    priority: Option<i32>,
    metadata: Option<Metadata>,
    accept: Option<Gates>,
    webhook: Option<Webhook>,
}

impl HandlingBuilder {
    /// Names of the settings.
    pub const NAMES: [&str; 4] = ["priority", "metadata", "accept", "webhook"];

    /// Records the setting with one of these names.
    pub fn take(&mut self, name: &str, text: &str) -> Result<(), Problem> {
        let is_new = match name {
            "priority" => self.priority.replace(priority(text)?).is_none(),
            "accept" => self.accept.replace(gates(text)?).is_none(),
            "webhook" => self.webhook.replace(webhook(text)?).is_none(),
            _ => self.metadata.replace(metadata(text)?).is_none(),
        };
        once(name, is_new)
    }

    /// Returns the handling for a job of this kind.
    pub fn into_handling(self, kind: Kind) -> Result<Handling, Problem> {
        if let Some(gates) = &self.accept {
            gates.check(kind).map_err(|error| refused(&error))?;
        }
        Ok(Handling {
            priority: self.priority.unwrap_or_default(),
            metadata: self.metadata.unwrap_or_default(),
            accept: self.accept,
            webhook: self.webhook,
        })
    }

    /// Rejects settings that require a stored job.
    pub fn check_unkept(&self) -> Result<(), Problem> {
        let name = match self {
            Self {
                metadata: Some(_), ..
            } => "metadata",
            Self {
                accept: Some(_), ..
            } => "accept",
            Self {
                webhook: Some(_), ..
            } => "webhook",
            _ => return Ok(()),
        };
        let detail = format!("nothing is kept of this call: `{name}` needs POST /v1/jobs");
        Err(Problem::new(Code::InvalidRequest, detail))
    }
}

fn priority(text: &str) -> Result<i32, Problem> {
    let priority = text.parse().ok();
    let priority = priority.filter(|priority| PRIORITIES.contains(priority));
    priority.ok_or_else(|| {
        let (low, high) = (PRIORITIES.start(), PRIORITIES.end());
        let detail = format!("`priority` must be a whole number from {low} to {high}");
        Problem::new(Code::InvalidRequest, detail)
    })
}

fn gates(text: &str) -> Result<Gates, Problem> {
    text.parse().map_err(|error| refused(&error))
}

fn refused(error: &GateError) -> Problem {
    Problem::new(Code::InvalidRequest, format!("`accept`: {error}"))
}

fn webhook(text: &str) -> Result<Webhook, Problem> {
    let webhook = text.parse::<Webhook>();
    webhook.map_err(|error| Problem::new(Code::InvalidRequest, format!("`webhook`: {error}")))
}

/// Parses metadata from its JSON text.
pub(super) fn metadata(text: &str) -> Result<Metadata, Problem> {
    let metadata = text.parse::<Metadata>();
    metadata.map_err(|error| Problem::new(Code::InvalidRequest, error.to_string()))
}

/// Rejects a repeated setting, because one of the two would be lost.
pub(super) fn once(name: &str, is_first: bool) -> Result<(), Problem> {
    if is_first {
        return Ok(());
    }
    let detail = format!("{name} is given twice");
    Err(Problem::new(Code::InvalidRequest, detail))
}
