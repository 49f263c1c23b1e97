//! Digests of everything that determines an output.

use super::worker::Extra;
use unwrapd_files::document::Upload;
use unwrapd_pipeline::{Options, Workers};
use unwrapd_server::jobs::Digest;

/// Digest of the settings shared by all assets of a run.
#[derive(Clone, Debug)]
pub(super) struct Recipe(Digest);

impl Recipe {
    /// Creates the digest of a worker's version, the options, and the extra files. The number of threads does not
    /// count, because outputs do not depend on it.
    pub fn new(version: &str, options: &Options, extras: &[Extra]) -> serde_json::Result<Self> {
        let options = Options {
            workers: Workers::default(),
            ..options.clone()
        };
        let mut digest = Digest::default();
        digest.add(version.as_bytes());
        digest.add(&serde_json::to_vec(&options)?);
        for extra in extras {
            digest.add(extra.suffix().as_bytes());
        }
        Ok(Self(digest))
    }

    /// Returns the digest of an asset.
    pub fn with(&self, upload: &Upload) -> String {
        let mut digest = self.0.clone();
        digest.add(upload.name.as_bytes());
        digest.add(&upload.bytes);
        for (name, bytes) in &upload.resources {
            digest.add(name.as_bytes());
            digest.add(bytes);
        }
        digest.finish()
    }
}
