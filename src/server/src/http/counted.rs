//! Metrics of connections.

use metrics::{counter, describe_counter, gauge};

/// Gauge of open connections.
pub(super) const OPEN: &str = "unwrapd_connections";
const REFUSED: &str = "unwrapd_connections_refused_total";

/// Describes the metrics and starts the counter at zero.
pub(super) fn describe() {
    let meaning = "Connections refused because their address had too many";
    describe_counter!(REFUSED, meaning);
    counter!(REFUSED).absolute(0);
}

/// Counts an open connection until it is dropped.
pub(super) struct Counted;

impl Counted {
    pub fn new() -> Self {
        gauge!(OPEN).increment(1.0);
        Self
    }

    /// Counts a refused connection.
    pub fn refused() -> Self {
        counter!(REFUSED).increment(1);
        Self::new()
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        gauge!(OPEN).decrement(1.0);
    }
}
