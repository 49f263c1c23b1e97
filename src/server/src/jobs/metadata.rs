//! Client metadata of jobs.

use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::digest::Digest;

/// Limits of the JSON text in bytes, and of its members. The text is stored with the job and repeated in every view
/// of it; each member is a row in the table of labels.
const MOST_BYTES: usize = 4096;
const MOST_MEMBERS: usize = 64;

/// Client metadata: a JSON object that is repeated wherever the job is shown, and by whose members jobs can be found.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Metadata(Map<String, Value>);

/// Error for a text that is not metadata.
#[derive(Debug, thiserror::Error)]
pub enum MetadataError {
    /// It is not a JSON object.
    #[error("metadata is not a JSON object: {0}")]
    Malformed(#[from] serde_json::Error),
    /// It is too large.
    #[error("metadata can have at most {MOST_BYTES} bytes of JSON and {MOST_MEMBERS} members")]
    TooLarge,
}

impl Metadata {
    /// Returns whether there are no members.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns a digest of each member, name and value, for lookups.
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
