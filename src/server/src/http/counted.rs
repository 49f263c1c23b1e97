//! How many connections there are, and how many were refused.

use metrics::{counter, describe_counter, gauge};

/// Connections now.
pub(super) const OPEN: &str = "unwrapd_connections";
const REFUSED: &str = "unwrapd_connections_refused_total";

/// Says what is counted here, and starts at zero.
pub(super) fn describe() {
    let meaning = "Connections refused because their address had too many";
    describe_counter!(REFUSED, meaning);
    counter!(REFUSED).absolute(0);
}

/// One more connection, until it is dropped.
pub(super) struct Counted;

impl Counted {
    pub fn new() -> Self {
        gauge!(OPEN).increment(1.0);
        Self
    }

    /// One that is refused.
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
