//! The HTTP interface: routes, problems, OpenAPI, progress, the page.
//!
//! It accepts, records and relays; it computes nothing, and delegates the drawing of pictures. Every handler is a few
//! lines around one call of [`crate::jobs`], and its doc comment is the text that clients read in the OpenAPI
//! document. Every error is an RFC 9457 problem with a stable code (`problem.rs` has the table).

mod admission;
mod app;
mod connections;
mod contents;
mod download;
mod exposition;
mod extract;
mod input;
mod jobs;
mod limits;
mod observation;
mod openapi;
mod operation;
mod origins;
mod page;
mod problem;
mod receiver;
mod results;
mod router;
mod schemas;
mod sessions;
mod socket;
mod submission;
mod synchronous;
mod upload;
mod view;
mod watch;

use std::sync::Arc;

use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use self::app::App;
pub use self::app::Settings;
pub use self::connections::Connections;
pub use self::exposition::{Exposition, Measured, measure};
use self::limits::Windows;
#[doc(hidden)]
pub use self::limits::{Crowds, Seat};
pub use self::origins::origin;
pub use self::router::openapi;
use crate::jobs::Jobs;
use crate::jobs::access::KeyRing;
use crate::sessions::Sessions;

/// Serves until told to stop; then completes the requests under way, closes WebSockets with 1001 and returns.
pub async fn serve(
    listener: TcpListener,
    (jobs, sessions, keys): (Arc<Jobs>, Arc<Sessions>, Arc<KeyRing>),
    exposition: Exposition,
    settings: Settings,
    stop: CancellationToken,
) -> std::io::Result<()> {
    // Build the state and the router.
    let app = Arc::new(App {
        jobs,
        sessions,
        keys,
        exposition,
        requests: settings.owner_requests.map(Windows::of),
        archives: Arc::default(),
        wrong_keys: Windows::of(settings.wrong_keys),
        settings,
        stop: stop.clone(),
        sockets: TaskTracker::new(),
    });
    let router = router::router(Arc::clone(&app)).map_err(std::io::Error::other)?;
    // End the sessions on a stop: their WebSockets would keep connections open.
    let (stopping, sessions) = (stop.clone(), Arc::clone(&app.sessions));
    let ended = tokio::spawn(async move {
        stopping.cancelled().await;
        sessions.stop().await;
    });
    // Serve, then wait for sessions and sockets to end.
    connections::serve(listener, router, &app.settings.connections, stop).await;
    ended.await.map_err(std::io::Error::other)?;
    app.sockets.close();
    app.sockets.wait().await;
    Ok(())
}
