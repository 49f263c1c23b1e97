//! Where the service listens: the same option for `serve` and for `health`.

use std::net::SocketAddr;

/// The address of the service.
#[derive(clap::Args)]
pub(super) struct Listen {
    /// Address of the service; port 0 takes a free one, `0.0.0.0` and `[::]` are every address of this machine
    #[arg(
        long = "listen",
        value_name = "ADDRESS",
        env = "UNWRAPD_LISTEN",
        default_value = "127.0.0.1:8080"
    )]
    pub address: SocketAddr,
}
