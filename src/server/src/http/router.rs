//! The router: admission, common response headers and fallbacks around the routes.

use std::any::Any;
use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::http::{HeaderValue, header};
use axum::middleware::{from_fn, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::csrf::ConfigError;
use tower_http::set_header::SetResponseHeaderLayer;

use super::problem::{Code, Problem};
use super::{App, admission, observation, open_routes, origins, pages, routes};

/// Allows scripts, workers, styles and connections of this host only; no frames, and no forms elsewhere. `blob:` is
/// for data that the page creates: pictures inside meshes.
const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self'; \
    img-src 'self' blob: data:; connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Cache-Control of private responses: shared caches must not keep them, and they must not be shown after a sign-out.
const NOT_SHARED: &str = "private, no-cache";

/// Returns all routes with their layers.
pub(super) fn router(app: Arc<App>) -> Result<Router, ConfigError> {
    // Admit requests to the routes that need a key, and add the open routes, the pages and the fallbacks.
    let header =
        |name, value| SetResponseHeaderLayer::if_not_present(name, HeaderValue::from_static(value));
    let settings = app.settings.clone();
    let admitted = from_fn_with_state(Arc::clone(&app), admission::admit);
    let answering = Router::from(routes())
        .route_layer(admitted)
        .route_layer(header(header::CACHE_CONTROL, NOT_SHARED))
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
        .layer(header(
            header::CONTENT_SECURITY_POLICY,
            CONTENT_SECURITY_POLICY,
        ))
        .layer(header(header::X_CONTENT_TYPE_OPTIONS, "nosniff"))
        .layer(header(header::REFERRER_POLICY, "no-referrer"))
        .layer(from_fn(observation::observe)))
}

#[allow(clippy::needless_pass_by_value, reason = "the layer hands it over")]
fn panicked(_: Box<dyn Any + Send>) -> Response {
    Problem::new(Code::InternalError, "a bug of the service").into_response()
}
