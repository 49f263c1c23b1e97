//! The router: all routes, with admission, common response headers and fallbacks around them.

use std::any::Any;
use std::sync::{Arc, OnceLock};

use axum::extract::{DefaultBodyLimit, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::middleware::{from_fn, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::{Router, routing::get};
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::csrf::ConfigError;
use tower_http::set_header::SetResponseHeaderLayer;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::app::{App, Shared};
use super::openapi::{document, preamble};
use super::page::{self, StaticAsset};
use super::problem::{Code, Problem};
use super::{
    admission, jobs, observation, operation, origins, results, sessions, synchronous, watch,
};
use unwrapd_api::Catalog;

/// Allows scripts, workers, styles and connections of this host only; no frames, and no forms elsewhere. `blob:` is
/// for data that the page creates: pictures inside meshes, and the workers of the decoder of Draco, which is WebAssembly like that of meshopt.
const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; style-src 'self'; \
    img-src 'self' blob: data:; connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Cache-Control of private responses: shared caches must not keep them, and they must not be shown after a sign-out.
const NOT_SHARED: &str = "private, no-cache";

/// Returns all routes with their layers.
pub(super) fn router(app: Arc<App>) -> Result<Router, ConfigError> {
    // Admit requests to the routes that need a key, and add the open routes, the pages and the fallbacks.
    let settings = app.settings.clone();
    let admitted = from_fn_with_state(Arc::clone(&app), admission::admit);
    let answering = Router::from(routes())
        .route_layer(admitted)
        .route_layer(default_header(header::CACHE_CONTROL, NOT_SHARED))
        .merge(Router::from(open_routes()))
        .merge(pages())
        .fallback(async || Problem::new(Code::NotFound, "there is nothing at this path"))
        .method_not_allowed_fallback(async || {
            Problem::new(Code::MethodNotAllowed, "Allow lists what this path answers")
        })
        // Uploads count their bytes themselves.
        .layer(DefaultBodyLimit::disable())
        .layer(CatchPanicLayer::custom(panicked))
        .with_state(app);
    // Guard all of them, and set the headers of every response.
    Ok(origins::guarded(answering, &settings)?
        .layer(default_header(
            header::CONTENT_SECURITY_POLICY,
            CONTENT_SECURITY_POLICY,
        ))
        .layer(default_header(header::X_CONTENT_TYPE_OPTIONS, "nosniff"))
        .layer(default_header(header::REFERRER_POLICY, "no-referrer"))
        .layer(from_fn(observation::observe)))
}

/// Returns a layer that sets a header of the responses that do not have it.
fn default_header(name: HeaderName, value: &'static str) -> SetResponseHeaderLayer<HeaderValue> {
    SetResponseHeaderLayer::if_not_present(name, HeaderValue::from_static(value))
}

#[allow(clippy::needless_pass_by_value, reason = "the layer hands it over")]
fn panicked(_: Box<dyn Any + Send>) -> Response {
    Problem::new(Code::InternalError, "a bug of the service").into_response()
}

/// Returns the routes that need a key once one exists. The OpenAPI document lists these and the open routes.
fn routes() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::with_openapi(preamble())
        .routes(routes!(jobs::create_job, jobs::list_jobs))
        .routes(routes!(jobs::get_job, jobs::change_job, jobs::delete_job))
        .routes(routes!(jobs::finish_job))
        .routes(routes!(jobs::retry_job))
        .routes(routes!(jobs::retry_jobs))
        .routes(routes!(watch::watch_job))
        .routes(routes!(watch::watch_maps))
        .routes(routes!(results::get_input))
        .routes(routes!(results::get_result))
        .routes(routes!(results::get_report))
        .routes(routes!(results::get_layout))
        .routes(routes!(results::get_heatmap))
        .routes(routes!(results::get_thumbnail))
        .routes(routes!(results::get_uvs))
        .routes(routes!(results::get_file))
        .routes(routes!(results::get_files))
        .routes(routes!(sessions::open_session, sessions::list_sessions))
        .routes(routes!(sessions::get_session, sessions::close_session))
        .routes(routes!(sessions::bake_session))
        .routes(routes!(sessions::pull_session))
        .routes(routes!(
            admission::get_caller,
            admission::sign_in,
            admission::sign_out
        ))
        .routes(routes!(synchronous::unwrap))
        .routes(routes!(synchronous::measure))
        .routes(routes!(synchronous::decode))
        .routes(routes!(
            operation::start_drain,
            operation::end_drain,
            operation::get_drain
        ))
        .routes(routes!(
            operation::pause_queue,
            operation::resume_queue,
            operation::get_pause
        ))
        .routes(routes!(operation::metrics))
}

/// Returns the routes that need no key.
fn open_routes() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::new()
        .routes(routes!(operation::healthz))
        .routes(routes!(operation::readyz))
        .routes(routes!(openapi_document))
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
    document(routes().merge(open_routes()).into_openapi(), catalog, &open)
}

/// Get this document.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "openapi", tag = "service",
    responses(
        (status = 200, description = "OpenAPI 3.1", body = Object, content_type = "application/json"),
        (status = 304, description = "The document is unchanged"),
    )
)]
async fn openapi_document(State(app): Shared, headers: HeaderMap) -> Response {
    static DOCUMENT: OnceLock<StaticAsset> = OnceLock::new();
    let asset = DOCUMENT.get_or_init(|| {
        let text = openapi(app.jobs.settings().catalog);
        StaticAsset::new("application/json", text.leak().as_bytes())
    });
    page::answer(asset, None, &headers)
}
