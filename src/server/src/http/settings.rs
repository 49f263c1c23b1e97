//! Limits of the HTTP interface, and its permitted users.

use std::time::Duration;

use crate::webhooks::Reachable;

/// Limits of requests and permitted origins.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Maximum bytes of an upload, all files together.
    pub upload_bytes: u64,
    /// Time limit of a synchronous request.
    pub synchronous_time: Duration,
    /// Limits of connections.
    pub connections: Connections,
    /// Time limit of an upload.
    pub upload_time: Duration,
    /// Minimum rate of a body in bytes per second, on average over each period of `connections.silence`.
    pub upload_rate: u64,
    /// Maximum number of requests per owner and minute; `None` without a limit.
    pub owner_requests: Option<u32>,
    /// Maximum number of wrong keys per address and minute.
    pub wrong_keys: u32,
    /// Origins, such as `https://example.org`, whose pages may use the service.
    pub origins: Vec<String>,
    /// Permitted host names beside addresses and `localhost`; `None` if any name is permitted.
    pub hosts: Option<Vec<String>>,
    /// Addresses that webhooks may use; `None` if there are no webhooks.
    pub webhooks: Option<Reachable>,
    /// Path that a proxy puts in front of all paths; empty without one.
    pub base_path: String,
}

impl Connections {
    /// Limits for collectors of metrics.
    pub(super) const OF_COLLECTORS: Self = Self {
        most: 16,
        most_of_address: None,
        header_time: Duration::from_mins(2),
        silence: Duration::from_secs(30),
    };
}

/// Limits of connections.
#[derive(Clone, Debug)]
pub struct Connections {
    /// Maximum number of connections. Others wait until one of them ends.
    pub most: usize,
    /// Maximum number of connections per address. Others are refused.
    pub most_of_address: Option<usize>,
    /// Timeout for the headers of a request, and between two requests.
    pub header_time: Duration,
    /// Timeout between two chunks of a body, in either direction.
    pub silence: Duration,
}
