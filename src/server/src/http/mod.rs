//! The HTTP interface: routes, problems, OpenAPI, progress, the page.
//!
//! It accepts, records and relays; it computes nothing, and delegates the drawing of pictures. Every handler is a few
//! lines around one call of [`crate::jobs`], and its doc comment is the text that clients read in the OpenAPI
//! document. Every error is an RFC 9457 problem with a stable code (`code.rs` has the table).

mod admission;
mod answers;
mod app;
mod assets;
mod causes;
mod code;
mod connections;
mod counted;
mod create;
mod crowds;
mod download;
mod drain;
mod events;
mod exposition;
mod extract;
mod framing;
mod handling;
mod inputs;
mod jobs;
mod list;
mod live;
mod maps;
mod missing;
mod observation;
mod openapi;
mod options;
mod origins;
mod pack;
mod page;
mod parts;
mod pause;
mod probes;
mod problem;
mod received;
mod receiver;
mod references;
mod results;
mod router;
mod schemas;
mod scopes;
mod session_input;
mod sessions;
mod settings;
mod sign_in;
mod socket;
mod submission_headers;
mod synchronous;
mod unpack;
mod upload;
mod view;
mod windows;

use std::sync::Arc;

use axum::{Router, routing::get};
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use self::app::App;
pub use self::exposition::{Exposition, Measured, measure};
pub use self::origins::origin;
pub use self::settings::{Connections, Settings};
use self::windows::Windows;
use crate::jobs::Jobs;
use crate::jobs::access::KeyRing;
use crate::sessions::Sessions;
use unwrapd_api::Catalog;

/// Returns the routes that need a key once one exists. The OpenAPI document lists these and the open routes.
fn routes() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::with_openapi(openapi::preamble())
        .routes(routes!(create::create_job, list::list_jobs))
        .routes(routes!(jobs::get_job, jobs::delete_job))
        .routes(routes!(jobs::finish_job))
        .routes(routes!(jobs::retry_job))
        .routes(routes!(list::retry_jobs))
        .routes(routes!(events::watch_job))
        .routes(routes!(maps::watch_maps))
        .routes(routes!(inputs::get_input))
        .routes(routes!(results::get_result))
        .routes(routes!(results::get_report))
        .routes(routes!(results::get_layout))
        .routes(routes!(results::get_heatmap))
        .routes(routes!(results::get_thumbnail))
        .routes(routes!(results::get_uvs))
        .routes(routes!(results::get_file))
        .routes(routes!(pack::get_files))
        .routes(routes!(sessions::open_session, sessions::list_sessions))
        .routes(routes!(sessions::get_session, sessions::close_session))
        .routes(routes!(sessions::bake_session))
        .routes(routes!(live::pull_session))
        .routes(routes!(
            sign_in::get_caller,
            sign_in::sign_in,
            sign_in::sign_out
        ))
        .routes(routes!(synchronous::unwrap))
        .routes(routes!(synchronous::measure))
        .routes(routes!(
            drain::start_drain,
            drain::end_drain,
            drain::get_drain
        ))
        .routes(routes!(
            pause::pause_queue,
            pause::resume_queue,
            pause::get_pause
        ))
        .routes(routes!(probes::metrics))
}

/// Returns the routes that need no key.
fn open_routes() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::new()
        .routes(routes!(probes::healthz))
        .routes(routes!(probes::readyz))
        .routes(routes!(probes::openapi_document))
}

/// Returns the routes of the pages for people and of their assets.
fn pages() -> Router<Arc<App>> {
    Router::new()
        .route("/", get(page::index))
        .route("/docs", get(page::docs))
        .route("/assets/{name}", get(page::asset))
}

/// Returns the OpenAPI document of the service as JSON.
pub fn openapi(catalog: &dyn Catalog) -> String {
    let open = open_routes().into_openapi().paths.paths;
    let open: Vec<String> = open.into_keys().collect();
    openapi::document(routes().merge(open_routes()).into_openapi(), catalog, &open)
}

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
