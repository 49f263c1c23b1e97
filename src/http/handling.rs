//! What an upload says of its job beside kind, options and files, in the query or in parts of a form.

use std::ops::RangeInclusive;

use super::problem::{Code, Problem};
use crate::jobs::{Handling, Metadata};

/// Priorities that a client may ask for.
const PRIORITIES: RangeInclusive<i32> = -100..=100;

/// What was said so far.
#[derive(Default)]
pub(super) struct Said {
    priority: Option<i32>,
    metadata: Option<Metadata>,
}

impl Said {
    /// The names of what can be said.
    pub const NAMES: [&str; 2] = ["priority", "metadata"];

    /// Takes what is said under one of these names.
    pub fn take(&mut self, name: &str, text: &str) -> Result<(), Problem> {
        let is_new = match name {
            "priority" => self.priority.replace(priority(text)?).is_none(),
            _ => self.metadata.replace(metadata(text)?).is_none(),
        };
        once(name, is_new)
    }

    /// All of it.
    pub fn into_handling(self) -> Handling {
        Handling {
            priority: self.priority.unwrap_or_default(),
            metadata: self.metadata.unwrap_or_default(),
        }
    }

    /// Refuses what only a job that is kept can have.
    pub fn check_unkept(&self) -> Result<(), Problem> {
        if self.metadata.is_none() {
            return Ok(());
        }
        let detail = "nothing is kept of this call: metadata needs POST /v1/jobs";
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

/// Metadata from its JSON text.
pub(super) fn metadata(text: &str) -> Result<Metadata, Problem> {
    let metadata = text.parse::<Metadata>();
    metadata.map_err(|error| Problem::new(Code::InvalidRequest, error.to_string()))
}

/// Refuses what is given more than once: one of two would be lost.
pub(super) fn once(name: &str, is_first: bool) -> Result<(), Problem> {
    if is_first {
        return Ok(());
    }
    let detail = format!("{name} is given twice");
    Err(Problem::new(Code::InvalidRequest, detail))
}
