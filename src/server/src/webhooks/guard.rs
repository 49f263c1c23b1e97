//! Name resolution restricted to permitted addresses.

use std::net::{IpAddr, SocketAddr};

use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use url::Host;

use super::address::is_public;
use crate::jobs::Webhook;

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
pub(super) struct Guard(pub Reachable);

impl Resolve for Guard {
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
