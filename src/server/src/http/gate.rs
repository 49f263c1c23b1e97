//! Connection limits, global and per address.

use std::io::{Error, ErrorKind};
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::crowds::{Crowds, Seat};
use super::refused::Refused;
use super::settings::Connections;

/// Delay after a temporary error, such as too many open files.
const PAUSE: Duration = Duration::from_millis(200);

/// Accepts connections within the limits.
pub(super) struct Gate {
    listener: TcpListener,
    places: Arc<Semaphore>,
    crowds: Arc<Crowds<IpAddr>>,
    most_of_address: Option<usize>,
    refused: Refused,
}

/// Slots of a connection, global and of its address, until it is dropped.
pub(super) type Place = (Option<OwnedSemaphorePermit>, Seat<IpAddr>);

impl Gate {
    /// Creates a gate with these limits.
    pub fn new(listener: TcpListener, limits: &Connections) -> Self {
        Self {
            listener,
            places: Arc::new(Semaphore::new(limits.most)),
            crowds: Arc::default(),
            most_of_address: limits.most_of_address,
            refused: Refused::of_more_than(limits.most_of_address.unwrap_or(limits.most)),
        }
    }

    /// Waits for the next connection that may stay. Connections of addresses that have too many are refused meanwhile
    /// and take no slot.
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

/// Accepts the next connection from any address.
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
