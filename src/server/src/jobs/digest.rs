//! Digests of work requests.

use sha2::{Digest as _, Sha256};
use unwrapd_api::{InputFile, Kind};

/// SHA-256 of a sequence of texts. Lengths are hashed too, so different sequences never hash the same bytes.
#[derive(Clone, Debug, Default)]
pub struct Digest(Sha256);

impl Digest {
    /// Adds a text with its length.
    pub fn add(&mut self, text: &[u8]) {
        self.0.update((text.len() as u64).to_le_bytes());
        self.0.update(text);
    }

    /// Returns the digest of a job of this kind with these options and input files.
    pub fn of_job<'a>(
        kind: Kind,
        options: &serde_json::Value,
        files: impl Iterator<Item = &'a InputFile>,
    ) -> String {
        let mut digest = Self::default();
        digest.add(kind.word().as_bytes());
        digest.add(options.to_string().as_bytes());
        for file in files {
            digest.add(file.name.as_bytes());
            digest.add(file.sha256.as_deref().unwrap_or_default().as_bytes());
        }
        digest.finish()
    }

    /// Returns the digest in hexadecimal digits.
    pub fn finish(self) -> String {
        format!("{:x}", self.0.finalize())
    }
}
