//! Limits of the HTTP interface.

use std::time::Duration;

/// What one request may ask for.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Bytes of an upload, all its files together.
    pub upload_bytes: u64,
    /// How long a synchronous call may compute.
    pub synchronous_time: Duration,
}
