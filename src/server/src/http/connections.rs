//! Connections: their number, timeouts, shutdown and metrics.
//!
//! A silent peer loses its connection: without headers, between two requests, or within a body in either direction.
//! Until then it keeps its slot, and others wait when all slots are taken. A limit per address keeps a single address
//! from taking all of them.

use std::collections::VecDeque;
use std::io::{self, Error, ErrorKind};
use std::net::{IpAddr, SocketAddr};
use std::pin::{Pin, pin};
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use axum::Router;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1::Builder;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use metrics::{counter, describe_counter, gauge};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_io_timeout::TimeoutStream;
use tokio_util::sync::CancellationToken;
use tokio_util::task::{AbortOnDropHandle, TaskTracker};

use super::limits::{Crowds, Seat};
use super::problem::{Code, Problem};

/// Limits of connections.
#[derive(Clone, Debug)]
pub struct Connections {
    /// Maximum number of connections. Others wait until one of them ends.
    pub most: usize,
    /// Maximum number of connections per address. Others are refused.
    pub most_of_address: Option<usize>,
    /// Timeout for the headers of a request, and between two requests.
    pub header_time: Duration,
    /// Timeout between two chunks of a body, in either direction.
    pub silence: Duration,
}

impl Connections {
    /// Limits for collectors of metrics.
    pub(super) const OF_COLLECTORS: Self = Self {
        most: 16,
        most_of_address: None,
        header_time: Duration::from_mins(2),
        silence: Duration::from_secs(30),
    };
}

/// Address that a request comes from: that of the last proxy, if there is one.
#[derive(Clone, Copy)]
pub(super) struct Peer(pub IpAddr);

/// Serves connections until told to stop, then completes the requests under way.
pub(super) async fn serve(
    listener: TcpListener,
    router: Router,
    limits: &Connections,
    stop: CancellationToken,
) {
    let mut gate = ConnectionGate::new(listener, limits);
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
        let stream = ConnectionWithSlot::new(stream, limits.silence, (place, Counted::new()));
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
            // Errors mean that the client is gone or silent.
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

// Connection limits, global and per address.

/// Delay after a temporary error, such as too many open files. Accepting again at once would fail in the same way and
/// keep a core busy.
const PAUSE: Duration = Duration::from_millis(200);

/// Accepts connections within the limits.
struct ConnectionGate {
    listener: TcpListener,
    places: Arc<Semaphore>,
    crowds: Arc<Crowds<IpAddr>>,
    most_of_address: Option<usize>,
    refused: Refused,
}

/// Slots of a connection, global and of its address, until it is dropped.
type ConnectionPlace = (Option<OwnedSemaphorePermit>, Seat<IpAddr>);

impl ConnectionGate {
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
    pub async fn next(&mut self) -> (TcpStream, IpAddr, ConnectionPlace) {
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
                // Otherwise a frame behind a reply would wait up to 40 ms for the acknowledgment of the reply.
                let _ = stream.set_nodelay(true);
                return (stream, address);
            }
            // The client is gone already.
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

// Refusal of connections whose address has too many. They have a few slots of their own, so that they delay
// nobody else.

/// Time for the request of a refused client. Silent clients take one of the slots for refusals this long.
const TIME: Duration = Duration::from_secs(1);
/// Maximum number of refusals under way. Each takes an open file; with fewer slots, clients are pushed out before
/// they are answered. `tests/bench/hostile.py --fresh --elsewhere` measures the effect on other clients.
const MOST: usize = 32;

/// Connections waiting for their refusal, oldest first.
struct Refused {
    answer: Router,
    waiting: VecDeque<AbortOnDropHandle<()>>,
}

impl Refused {
    /// Creates an empty set. The refusal states the limit per address, `most`.
    pub fn of_more_than(most: usize) -> Self {
        let answer = Router::new().fallback(async move || {
            let detail = format!("an address may have {most} connections at a time");
            Problem::new(Code::TooManyConnections, detail).with_limit(most as u64)
        });
        Self {
            answer,
            waiting: VecDeque::with_capacity(MOST),
        }
    }

    /// Answers the request of a connection with a refusal, then closes it. Closes it without an answer if no request
    /// comes within a second, or if it is the oldest of too many. Never waits.
    pub fn add(&mut self, stream: TcpStream) {
        // Make room.
        self.waiting.retain(|one| !one.is_finished());
        if self.waiting.len() == MOST {
            self.waiting.pop_front();
        }
        // Answer in a task of its own, so that the gate does not wait.
        let service = TowerToHyperService::new(self.answer.clone());
        let counted = Counted::refused();
        let answered = async move {
            let _counted = counted;
            let mut http1 = Builder::new();
            let connection = http1.keep_alive(false);
            let connection = connection.serve_connection(TokioIo::new(stream), service);
            // Errors mean that the client is gone or silent.
            let _ = tokio::time::timeout(TIME, connection).await;
        };
        let waiting = AbortOnDropHandle::new(tokio::spawn(answered));
        self.waiting.push_back(waiting);
    }
}

// Connections that keep their slot until they are closed, even after an upgrade to a WebSocket.

/// A connection together with its slot.
struct ConnectionWithSlot<P> {
    stream: Pin<Box<TimeoutStream<TcpStream>>>,
    _place: P,
}

impl<P> ConnectionWithSlot<P> {
    /// Creates a connection that fails if nothing can be written for the time `silence`.
    pub fn new(stream: TcpStream, silence: Duration, place: P) -> Self {
        let mut stream = TimeoutStream::new(stream);
        stream.set_write_timeout(Some(silence));
        Self {
            stream: Box::pin(stream),
            _place: place,
        }
    }
}

impl<P: Unpin> AsyncRead for ConnectionWithSlot<P> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        self.stream.as_mut().poll_read(context, buffer)
    }
}

impl<P: Unpin> AsyncWrite for ConnectionWithSlot<P> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        self.stream.as_mut().poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream.as_mut().poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream.as_mut().poll_shutdown(context)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        self.stream.as_mut().poll_write_vectored(context, parts)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }
}

// Metrics of connections.

/// Gauge of open connections.
pub(super) const OPEN: &str = "unwrapd_connections";
const REFUSED: &str = "unwrapd_connections_refused_total";

/// Describes the metrics and starts the counter at zero.
pub(super) fn describe() {
    let meaning = "Connections refused because their address had too many";
    describe_counter!(REFUSED, meaning);
    counter!(REFUSED).absolute(0);
}

/// Counts an open connection until it is dropped.
struct Counted;

impl Counted {
    pub fn new() -> Self {
        gauge!(OPEN).increment(1.0);
        Self
    }

    /// Counts a refused connection.
    pub fn refused() -> Self {
        counter!(REFUSED).increment(1);
        Self::new()
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        gauge!(OPEN).decrement(1.0);
    }
}
