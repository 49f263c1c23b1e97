//! Ports for servers that cannot choose one and tell.

use std::net::TcpListener;
use std::ops::Range;

use unwrapd::numerics::random::Random;

/// Below those that the system gives to outgoing connections: a server that is down finds its port
/// free when it comes back.
const RANGE: Range<u16> = 15_000..32_000;

/// A port that is free now.
pub fn free_port() -> u16 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let nanos = now.expect("after 1970").as_nanos() as u64;
    let mut random = Random::new(nanos ^ u64::from(std::process::id()) << 32);
    loop {
        let port = RANGE.start + random.below(RANGE.len()) as u16;
        if TcpListener::bind(("127.0.0.1", port)).is_ok() {
            return port;
        }
    }
}
