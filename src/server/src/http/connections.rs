//! Connections: their number, timeouts and shutdown.
//!
//! A silent peer loses its connection: without headers, between two requests, or within a body in either direction.
//! Until then it keeps its slot, and others wait when all slots are taken. A limit per address keeps a single address
//! from taking all of them (`gate.rs`).

use std::pin::pin;

use axum::Router;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1::Builder;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::admission::Peer;
use super::counted::Counted;
use super::gate::Gate;
use super::held::Held;
use super::settings::Connections;

/// Serves connections until told to stop, then completes the requests under way.
pub(super) async fn serve(
    listener: TcpListener,
    router: Router,
    limits: &Connections,
    stop: CancellationToken,
) {
    let mut gate = Gate::new(listener, limits);
    let open = TaskTracker::new();
    loop {
        let (stream, peer, place) = tokio::select! {
            () = stop.cancelled() => break,
            passed = gate.next() => passed,
        };
        // Build the service of this connection, which knows its peer.
        let mut http1 = Builder::new();
        http1.timer(TokioTimer::new());
        http1.header_read_timeout(limits.header_time);
        let stream = Held::new(stream, limits.silence, (place, Counted::new()));
        let service = TowerToHyperService::new(router.clone());
        let service = service_fn(move |mut request: Request<Incoming>| {
            request.extensions_mut().insert(Peer(peer));
            service.call(request)
        });
        // Serve it, and let it finish its requests when the service stops.
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
    drop(gate);
    open.close();
    open.wait().await;
}
