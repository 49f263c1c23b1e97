//! Connections: how many there are, how long they may be silent, and how they end.
//!
//! Whoever is silent loses the connection: without headers, between two requests, within a body that
//! comes or goes. So a client that holds connections open and says nothing keeps nobody out.

use std::io::ErrorKind;
use std::net::SocketAddr;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1::Builder;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use metrics::{counter, describe_counter, gauge};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::admission::Peer;
use super::crowds::Crowds;
use super::held::Held;
use super::problem::{Code, Problem};
use super::settings::Connections;

/// Connections now, and how many were refused.
pub(super) const OPEN: &str = "unwrapd_connections";
const REFUSED: &str = "unwrapd_connections_refused_total";

/// Says what is counted here, and starts at zero.
pub(super) fn describe() {
    let meaning = "Connections refused because their address had too many";
    describe_counter!(REFUSED, meaning);
    counter!(REFUSED).absolute(0);
}

/// After an error that may pass, such as too many open files.
const PAUSE: Duration = Duration::from_millis(200);
/// For the request of a client that gets no connection.
const REFUSAL_TIME: Duration = Duration::from_secs(1);

/// Serves until told to stop, then answers what is under way.
pub(super) async fn serve(
    listener: TcpListener,
    router: Router,
    limits: &Connections,
    stop: CancellationToken,
) {
    let places = Arc::new(Semaphore::new(limits.most));
    let crowds = Arc::new(Crowds::default());
    let open = TaskTracker::new();
    loop {
        let next = async {
            // The semaphore is never closed.
            let place = Arc::clone(&places).acquire_owned().await.ok();
            (accepted(&listener).await, place)
        };
        let ((stream, peer), place) = tokio::select! {
            () = stop.cancelled() => break,
            next = next => next,
        };
        let seat = Crowds::enter(&crowds, peer.ip(), limits.most_of_address);
        let mut http1 = Builder::new();
        http1.timer(TokioTimer::new());
        let service = if seat.is_some() {
            http1.header_read_timeout(limits.header_time);
            router.clone()
        } else {
            http1.header_read_timeout(REFUSAL_TIME).keep_alive(false);
            refusal(limits)
        };
        if seat.is_none() {
            counter!(REFUSED).increment(1);
        }
        let stream = Held::new(stream, limits.silence, (seat, place, Counted::new()));
        let service = TowerToHyperService::new(service);
        let service = service_fn(move |mut request: Request<Incoming>| {
            request.extensions_mut().insert(Peer(peer.ip()));
            service.call(request)
        });
        let connection = http1.serve_connection(TokioIo::new(stream), service);
        let stop = stop.clone();
        open.spawn(async move {
            let mut connection = pin!(connection.with_upgrades());
            // What goes wrong here is the client's going away, or its silence.
            let is_ended = tokio::select! {
                _ = connection.as_mut() => true,
                () = stop.cancelled() => false,
            };
            if !is_ended {
                connection.as_mut().graceful_shutdown();
                let _ = connection.await;
            }
        });
    }
    drop(listener);
    open.close();
    open.wait().await;
}

/// The next connection.
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

fn is_of_client(error: &std::io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::ConnectionRefused | ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset
    )
}

/// What answers a client that has too many connections.
fn refusal(limits: &Connections) -> Router {
    let most = limits.most_of_address.unwrap_or_default();
    Router::new().fallback(async move || {
        let detail = format!("an address may have {most} connections at a time");
        Problem::new(Code::TooManyConnections, detail).with_limit(most as u64)
    })
}

/// One more connection, until it is dropped.
struct Counted;

impl Counted {
    fn new() -> Self {
        gauge!(OPEN).increment(1.0);
        Self
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        gauge!(OPEN).decrement(1.0);
    }
}
