//! What clients note of their jobs.

use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::digest::Digest;

/// Bytes of the JSON text, and members.
const MOST_BYTES: usize = 4096;
const MOST_MEMBERS: usize = 64;

/// What a client notes of a job: a JSON object, which is repeated wherever the job is shown, and by
/// whose members jobs are found.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Metadata(Map<String, Value>);

/// What is no metadata.
#[derive(Debug, thiserror::Error)]
pub enum MetadataError {
    /// It is not a JSON object.
    #[error("metadata is not a JSON object: {0}")]
    Malformed(#[from] serde_json::Error),
    /// It is too long.
    #[error("metadata can have at most {MOST_BYTES} bytes of JSON and {MOST_MEMBERS} members")]
    TooLarge,
}

impl Metadata {
    /// Whether nothing is noted.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A digest of each member, name and value, by which it is looked up.
    pub fn labels(&self) -> Vec<String> {
        let label = |(name, value): (&String, &Value)| {
            let mut label = Digest::default();
            label.add(name.as_bytes());
            label.add(value.to_string().as_bytes());
            label.finish()
        };
        self.0.iter().map(label).collect()
    }
}

impl FromStr for Metadata {
    type Err = MetadataError;

    fn from_str(text: &str) -> Result<Self, MetadataError> {
        if MOST_BYTES < text.len() {
            return Err(MetadataError::TooLarge);
        }
        let metadata: Self = serde_json::from_str(text)?;
        if MOST_MEMBERS < metadata.0.len() {
            return Err(MetadataError::TooLarge);
        }
        Ok(metadata)
    }
}
