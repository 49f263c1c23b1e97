//! Who gets a connection: whoever has fewer than an address may have, once there is a place.

use std::io::{Error, ErrorKind};
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::crowds::{Crowds, Seat};
use super::refused::Refused;
use super::settings::Connections;

/// After an error that may pass, such as too many open files.
const PAUSE: Duration = Duration::from_millis(200);

/// What connections come through.
pub(super) struct Gate {
    listener: TcpListener,
    places: Arc<Semaphore>,
    crowds: Arc<Crowds<IpAddr>>,
    most_of_address: Option<usize>,
    refused: Refused,
}

/// What a connection has of the places of all and of those of its address, until it is dropped.
pub(super) type Place = (Option<OwnedSemaphorePermit>, Seat<IpAddr>);

impl Gate {
    /// A gate that lets so many in.
    pub fn new(listener: TcpListener, limits: &Connections) -> Self {
        Self {
            listener,
            places: Arc::new(Semaphore::new(limits.most)),
            crowds: Arc::default(),
            most_of_address: limits.most_of_address,
            refused: Refused::of_more_than(limits.most_of_address.unwrap_or(limits.most)),
        }
    }

    /// The next connection that may stay. Those of addresses that have too many are refused on the
    /// way and take no place.
    pub async fn next(&mut self) -> (TcpStream, IpAddr, Place) {
        // The semaphore is never closed.
        let place = Arc::clone(&self.places).acquire_owned().await.ok();
        loop {
            let (stream, peer) = accepted(&self.listener).await;
            match Crowds::enter(&self.crowds, peer.ip(), self.most_of_address) {
                Some(seat) => return (stream, peer.ip(), (place, seat)),
                None => self.refused.add(stream),
            }
        }
    }
}

/// The next connection of anybody.
async fn accepted(listener: &TcpListener) -> (TcpStream, SocketAddr) {
    loop {
        match listener.accept().await {
            Ok((stream, address)) => {
                // A frame behind a reply would else wait for the reply's acknowledgment: 40 ms.
                let _ = stream.set_nodelay(true);
                return (stream, address);
            }
            // The client has gone already.
            Err(error) if is_of_client(&error) => {}
            Err(error) => {
                tracing::error!(%error, "no connection can be accepted");
                tokio::time::sleep(PAUSE).await;
            }
        }
    }
}

fn is_of_client(error: &Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::ConnectionRefused | ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset
    )
}
