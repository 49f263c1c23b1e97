//! Limits of the HTTP interface, and who may use it.

use std::time::Duration;

use crate::webhooks::Reachable;

/// What one request may ask for, and where it may come from.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Bytes of an upload, all its files together.
    pub upload_bytes: u64,
    /// How long a synchronous call may compute.
    pub synchronous_time: Duration,
    /// How many connections there may be, and how long they may be silent.
    pub connections: Connections,
    /// How long an upload may take in all.
    pub upload_time: Duration,
    /// Bytes in a second that a body has to bring, on average over each time of `connections.silence`.
    pub upload_rate: u64,
    /// Requests that each owner may send in a minute.
    pub owner_requests: Option<u32>,
    /// Wrong keys that an address may send in a minute before it is told to wait.
    pub wrong_keys: u32,
    /// Origins, such as `https://example.org`, whose pages may use the service.
    pub origins: Vec<String>,
    /// Names under which the service is reached, beside addresses and `localhost`; none: any name.
    pub hosts: Option<Vec<String>>,
    /// Where webhooks may go; none if there are no webhooks.
    pub webhooks: Option<Reachable>,
    /// What a proxy puts in front of all paths; empty without one.
    pub base_path: String,
}

impl Connections {
    /// Of what collects measurements.
    pub(super) const OF_COLLECTORS: Self = Self {
        most: 16,
        most_of_address: None,
        header_time: Duration::from_mins(2),
        silence: Duration::from_secs(30),
    };
}

/// How many connections there may be, and how long they may be silent.
#[derive(Clone, Debug)]
pub struct Connections {
    /// Connections in all. Others wait until one of them ends.
    pub most: usize,
    /// Connections of one address. Others are refused.
    pub most_of_address: Option<usize>,
    /// For the headers of a request, and between two requests.
    pub header_time: Duration,
    /// Between two pieces of a body, in either direction.
    pub silence: Duration,
}
