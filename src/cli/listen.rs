//! The listening address: an option of `serve`, and a file for `health`.

use std::net::SocketAddr;

use tokio::net::TcpListener;

/// Name of the file in the data folder that contains the address.
pub(super) const ADDRESS_FILE: &str = "address";

/// Listens at an address.
pub(super) async fn listener(address: SocketAddr) -> Result<TcpListener, String> {
    let listener = TcpListener::bind(address).await;
    listener.map_err(|error| format!("cannot listen on {address}: {error}"))
}

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
