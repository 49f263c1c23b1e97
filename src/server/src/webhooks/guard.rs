//! Name resolution restricted to permitted addresses.

use crate::jobs::Webhook;
use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use url::Host;

/// Addresses that deliveries may go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reachable {
    /// Addresses of the public network.
    Public,
    /// All addresses, including this host and its network.
    Any,
}

/// Reason why an address is rejected.
#[derive(Debug, thiserror::Error)]
#[error("it is not an address of the public network")]
pub struct NotPublic;

impl Reachable {
    fn allows(self, address: IpAddr) -> bool {
        self == Self::Any || is_public(address)
    }
}

/// Checks that deliveries may go to an address, as far as possible without resolving its name.
pub fn check(webhook: &Webhook, reachable: Reachable) -> Result<(), NotPublic> {
    let is_allowed = match webhook.url().host() {
        Some(Host::Ipv4(address)) => reachable.allows(address.into()),
        Some(Host::Ipv6(address)) => reachable.allows(address.into()),
        Some(Host::Domain(_)) => true,
        None => false,
    };
    if is_allowed { Ok(()) } else { Err(NotPublic) }
}

/// Resolves names to their permitted addresses only. Connections use these addresses, so a name that changes its
/// meaning a moment later has no effect.
pub(super) struct AddressGuard(pub Reachable);

impl Resolve for AddressGuard {
    fn resolve(&self, name: Name) -> Resolving {
        let reachable = self.0;
        Box::pin(async move {
            let found = tokio::net::lookup_host((name.as_str(), 0)).await?;
            let allowed = found.filter(|address| reachable.allows(address.ip()));
            let allowed: Vec<SocketAddr> = allowed.collect();
            if allowed.is_empty() {
                return Err(NotPublic.into());
            }
            Ok(Box::new(allowed.into_iter()) as Addrs)
        })
    }
}

// Classification of network addresses.

/// Returns whether an address belongs to the public network: not to this host, not to a private network, and not to a
/// special-purpose range (RFC 6890). Addresses that embed an IPv4 address are judged by it.
pub fn is_public(address: IpAddr) -> bool {
    match address {
        IpAddr::V4(address) => is_public_v4(address),
        IpAddr::V6(address) => is_public_v6(address),
    }
}

fn is_public_v4(address: Ipv4Addr) -> bool {
    let [a, b, c, _] = address.octets();
    !(a == 0
        || address.is_loopback()
        || address.is_private()
        || address.is_link_local()
        || address.is_documentation()
        // Shared address space of a provider's customers (RFC 6598).
        || a == 100 && (64..128).contains(&b)
        // Protocol assignments (RFC 6890), and the former 6to4 relays (RFC 7526).
        || (a, b, c) == (192, 0, 0)
        || (a, b, c) == (192, 88, 99)
        // Benchmarks (RFC 2544).
        || a == 198 && (b == 18 || b == 19)
        // Multicast, reserved addresses and broadcast.
        || 224 <= a)
}

fn is_public_v6(address: Ipv6Addr) -> bool {
    let segments = address.segments();
    match segments {
        [0, 0, 0, 0, 0, 0xffff, high, low] | [0x64, 0xff9b, 0, 0, 0, 0, high, low] => {
            is_public_embedded(high, low)
        }
        [0x2002, high, low, ..] => is_public_embedded(high, low),
        // Teredo, benchmarks, ORCHID, documentation.
        [0x2001, second, ..] if second < 0x200 || second == 0xdb8 => false,
        // Global unicast, and nothing else.
        [first, ..] => first & 0xe000 == 0x2000,
    }
}

/// Returns whether the IPv4 address in two segments of an IPv6 address is public.
fn is_public_embedded(high: u16, low: u16) -> bool {
    let [a, b] = high.to_be_bytes();
    let [c, d] = low.to_be_bytes();
    is_public_v4(Ipv4Addr::new(a, b, c, d))
}
