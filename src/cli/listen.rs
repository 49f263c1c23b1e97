//! Where the service listens: the same option for `serve` and for `health`.

use std::net::SocketAddr;

/// The address of the service.
#[derive(clap::Args)]
pub(super) struct Listen {
    /// Address to listen on. Port 0 selects a free port; `0.0.0.0` and `[::]` listen on all
    /// interfaces
    #[arg(
        long = "listen",
        value_name = "ADDRESS",
        env = "UNWRAPD_LISTEN",
        default_value = "127.0.0.1:8080"
    )]
    pub address: SocketAddr,
}
