//! Checks of the origin of requests and of the host name that they use.
//!
//! A page of another site can make a browser send requests to a service that only this machine reaches. Browsers
//! state the origin of a request in `Sec-Fetch-Site` and `Origin`; these are checked for requests that change
//! something ([`CsrfLayer`]) and for WebSockets (here). A name that an attacker points at this machine (DNS
//! rebinding) shows in `Host`.

use std::sync::Arc;

use axum::Router;
use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Uri, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use tower_http::cors::{AllowHeaders, AllowMethods, AllowOrigin, CorsLayer};
use tower_http::csrf::{ConfigError, CsrfLayer, ProtectionError};

use super::app::Settings;
use super::limits;
use super::observation::REQUEST_ID;
use super::problem::{Code, Problem};

/// Response headers that scripts of other origins may read.
const EXPOSED: [HeaderName; 7] = [
    header::CONTENT_DISPOSITION,
    header::ETAG,
    header::LOCATION,
    header::RETRY_AFTER,
    REQUEST_ID,
    limits::LEFT,
    limits::POLICY,
];

/// Wraps a router in the checks of the settings.
pub(super) fn guarded(router: Router, settings: &Settings) -> Result<Router, ConfigError> {
    let mut csrf = CsrfLayer::new();
    for origin in &settings.origins {
        csrf = csrf.add_trusted_origin(origin)?;
    }
    let csrf = csrf.with_rejection_response(|_: ProtectionError| foreign().into_response());
    let allowed = Arc::new(Allowed {
        origins: settings.origins.clone(),
        hosts: settings.hosts.clone(),
    });
    let router = router.layer(csrf).layer(from_fn_with_state(allowed, guard));
    if settings.origins.is_empty() {
        return Ok(router);
    }
    let origins = (settings.origins.iter()).filter_map(|origin| HeaderValue::from_str(origin).ok());
    let cors = CorsLayer::new()
        .allow_origin(AllowOrigin::list(origins))
        .allow_methods(AllowMethods::mirror_request())
        .allow_headers(AllowHeaders::mirror_request())
        .expose_headers(EXPOSED);
    Ok(router.layer(cors))
}

/// Validates an origin as browsers send it, such as `https://example.org`.
pub fn origin(text: &str) -> Result<String, ConfigError> {
    let _ = CsrfLayer::new().add_trusted_origin(text)?;
    Ok(text.to_owned())
}

/// Permitted origins and host names.
struct Allowed {
    origins: Vec<String>,
    hosts: Option<Vec<String>>,
}

async fn guard(State(allowed): State<Arc<Allowed>>, request: Request, next: Next) -> Response {
    let (headers, uri) = (request.headers(), request.uri());
    if !names_one_host(headers) {
        let detail = "a request names one host, as NAME or NAME:PORT";
        return Problem::new(Code::InvalidRequest, detail).into_response();
    }
    let host = host(headers, uri);
    if !allowed.knows(host.as_ref()) {
        let detail = "the service is not known under this name; --allow-host adds one";
        return Problem::new(Code::UnknownHost, detail).into_response();
    }
    if headers.contains_key(header::UPGRADE) && !allowed.may_connect(headers, host.as_ref()) {
        return foreign().into_response();
    }
    next.run(request).await
}

/// Returns whether there is at most one `Host`, with a name and at most a port (RFC 9112, 3.2).
fn names_one_host(headers: &HeaderMap) -> bool {
    let mut hosts = headers.get_all(header::HOST).iter();
    let (first, second) = (hosts.next(), hosts.next());
    first.is_none_or(is_host) && second.is_none()
}

fn is_host(value: &HeaderValue) -> bool {
    let Some(authority) = (value.to_str().ok()).and_then(|text| text.parse::<Authority>().ok())
    else {
        // A request that is not for a host has an empty field.
        return value.is_empty();
    };
    let rest = authority.as_str().strip_prefix(authority.host());
    rest.is_some_and(|rest| rest.is_empty() || rest == ":" || authority.port_u16().is_some())
}

/// Returns the host name and port that a request uses for the service.
fn host(headers: &HeaderMap, uri: &Uri) -> Option<Authority> {
    if let Some(authority) = uri.authority() {
        return Some(authority.clone());
    }
    headers.get(header::HOST)?.to_str().ok()?.parse().ok()
}

impl Allowed {
    /// Returns whether a host is permitted: addresses and `localhost` always are, other names if they are listed.
    fn knows(&self, host: Option<&Authority>) -> bool {
        let Some(known) = &self.hosts else {
            return true;
        };
        let Some(name) = host.map(Authority::host) else {
            return false;
        };
        let address = name.trim_start_matches('[').trim_end_matches(']');
        address.parse::<std::net::IpAddr>().is_ok()
            || name.eq_ignore_ascii_case("localhost")
            || known.iter().any(|known| known.eq_ignore_ascii_case(name))
    }

    /// Returns whether a WebSocket may be opened: by anything but a browser, by our own page, or by a permitted
    /// origin.
    fn may_connect(&self, headers: &HeaderMap, host: Option<&Authority>) -> bool {
        let Some(origin) = headers.get(header::ORIGIN) else {
            return true;
        };
        let Ok(origin) = origin.to_str() else {
            return false;
        };
        let site = headers.get("sec-fetch-site").map(HeaderValue::as_bytes);
        let authority = origin.split_once("://").map(|(_, authority)| authority);
        self.origins.iter().any(|known| known == origin)
            || site == Some(b"same-origin")
            || authority.is_some() && authority == host.map(Authority::as_str)
    }
}

fn foreign() -> Problem {
    let detail = "a page of another origin asked; --allow-origin allows one";
    Problem::new(Code::ForeignOrigin, detail)
}
