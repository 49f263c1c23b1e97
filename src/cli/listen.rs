//! Where the service listens: an option of `serve`, and a file for `health`.

use std::net::SocketAddr;

/// The file of the data folder that has the address in it.
pub(super) const ADDRESS_FILE: &str = "address";

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
