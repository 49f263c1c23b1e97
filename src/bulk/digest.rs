//! What an output follows from, as one digest.

use std::fmt::Write;

use sha2::{Digest as _, Sha256};

use super::worker::Extra;
use crate::document::Upload;
use crate::pipeline::{Options, Workers};

/// What all assets of a run have in common.
#[derive(Clone, Debug)]
pub(super) struct Recipe(Sha256);

impl Recipe {
    /// The version of what works, the options, and what is written beside the output. The number of
    /// threads does not count: the output does not depend on it.
    pub fn new(version: &str, options: &Options, extras: &[Extra]) -> serde_json::Result<Self> {
        let options = Options {
            workers: Workers::default(),
            ..options.clone()
        };
        let mut hash = Sha256::new();
        add(&mut hash, version.as_bytes());
        add(&mut hash, &serde_json::to_vec(&options)?);
        for extra in extras {
            add(&mut hash, extra.suffix().as_bytes());
        }
        Ok(Self(hash))
    }

    /// The digest of an asset, in hexadecimal digits.
    pub fn with(&self, upload: &Upload) -> String {
        let mut hash = self.0.clone();
        add(&mut hash, upload.name.as_bytes());
        add(&mut hash, &upload.bytes);
        for (name, bytes) in &upload.resources {
            add(&mut hash, name.as_bytes());
            add(&mut hash, bytes);
        }
        let mut text = String::with_capacity(64);
        for byte in hash.finalize() {
            // A string takes whatever is written to it.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}

/// With its length, so that no two sequences are one text.
fn add(hash: &mut Sha256, bytes: &[u8]) {
    hash.update((bytes.len() as u64).to_le_bytes());
    hash.update(bytes);
}
