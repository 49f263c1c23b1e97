//! Authentication of requests by a key, in a header or in the cookie of a signed-in page.

use std::sync::Arc;

use axum::extract::{FromRequestParts, MatchedPath, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::app::{App, Shared};
use super::connections::Peer;
use super::problem::{Code, Problem};
use super::scopes::needed;
use super::upload::drain_refused;
use super::windows::Standing;
use crate::jobs::access::{Caller, Denied, Scope};

/// Name of the cookie of signed-in pages.
pub(super) const COOKIE: &str = "unwrapd-key";

/// Lets a request pass if its key has the needed scopes and its owner is within the rate limit. Attaches the
/// [`Caller`] to the request.
pub(super) async fn admit(
    State(app): Shared,
    path: MatchedPath,
    mut request: Request,
    next: Next,
) -> Result<Response, Problem> {
    // Authenticate the caller and check its scopes.
    let needed = needed(request.method(), path.as_str());
    let peer = request.extensions().get().copied();
    let caller = match caller(&app, request.headers(), peer, &needed).await {
        Ok(caller) => caller,
        Err(problem) => {
            // Answer at once, and read the body meanwhile: closing a connection with unread data would reset it before
            // the client sees the answer.
            tokio::spawn(drain_refused(request));
            return Err(problem);
        }
    };
    // Count the request against the rate limit of its owner.
    let taken = app.requests.as_ref();
    let taken = taken.map(|requests| requests.take(caller.owner().clone()));
    let mut response = if let Some(Err(standing)) = taken {
        tokio::spawn(drain_refused(request));
        let detail = "the owner of the key has sent too many requests";
        too_many(standing, detail).into_response()
    } else {
        request.extensions_mut().insert(caller);
        if is_encoded(request.headers()) {
            tokio::spawn(drain_refused(request));
            encoded().into_response()
        } else {
            next.run(request).await
        }
    };
    // Report the rest of the limit with every answer.
    if let Some(Ok(standing) | Err(standing)) = taken {
        standing.tell(response.headers_mut());
    }
    Ok(response)
}

/// Returns whether the body has a content coding, such as gzip.
fn is_encoded(headers: &HeaderMap) -> bool {
    let mut codings = headers.get_all(header::CONTENT_ENCODING).iter();
    codings.any(|coding| !coding.as_bytes().eq_ignore_ascii_case(b"identity"))
}

/// Rejects a content coding, and says which one is accepted (RFC 9110, 15.5.16).
fn encoded() -> Response {
    let detail = "a body is read as it is: send it without Content-Encoding";
    let refused = Problem::new(Code::UnsupportedMediaType, detail);
    ([(header::ACCEPT_ENCODING, "identity")], refused).into_response()
}

fn too_many(standing: Standing, detail: &str) -> Problem {
    Problem::new(Code::RateLimited, detail).retried_after(standing.reset)
}

/// Authenticates the caller and checks the scopes.
async fn caller(
    app: &App,
    headers: &HeaderMap,
    peer: Option<Peer>,
    needed: &[Scope],
) -> Result<Caller, Problem> {
    let caller = match app.keys.caller(key(headers)).await {
        Err(Denied::BadKey) => return Err(wrong_key(app, peer)),
        caller => caller?,
    };
    match needed.iter().find(|&&it| !caller.scopes().have(it)) {
        None => Ok(caller),
        Some(scope) => {
            let detail = format!("the key does not have the scope `{}`", scope.word());
            Err(Problem::new(Code::MissingScope, detail))
        }
    }
}

/// Returns the rejection of a wrong key, which counts against the address. Good keys from the same address are still
/// accepted, because it may be that of a proxy.
fn wrong_key(app: &App, peer: Option<Peer>) -> Problem {
    match peer.map(|Peer(address)| app.wrong_keys.take(address)) {
        Some(Err(standing)) => too_many(standing, "too many wrong keys came from this address"),
        _ => Denied::BadKey.into(),
    }
}

/// Returns the key of a request: the bearer token, or else the cookie.
fn key(headers: &HeaderMap) -> Option<&str> {
    let scheme = |text: &'_ str| text.get(..7).map(str::to_ascii_lowercase);
    let given = headers.get(header::AUTHORIZATION);
    let bearer = given
        .and_then(|value| value.to_str().ok())
        .filter(|text| scheme(text).as_deref() == Some("bearer "))
        .map(|text| text[7..].trim());
    let cookies = headers.get_all(header::COOKIE).iter();
    let mut cookies = cookies
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split(';'));
    bearer.or_else(|| {
        cookies.find_map(|cookie| cookie.trim().strip_prefix(COOKIE)?.strip_prefix('='))
    })
}

impl From<Denied> for Problem {
    fn from(denied: Denied) -> Self {
        match denied {
            Denied::NoKey => {
                let detail = "send it as `Authorization: Bearer KEY`";
                Self::new(Code::KeyRequired, detail)
            }
            Denied::BadKey => Self::new(Code::KeyRefused, "it is unknown, revoked or expired"),
            Denied::Store(error) => error.into(),
        }
    }
}

/// Extracts the caller that `admit` attached.
impl FromRequestParts<Arc<App>> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &Arc<App>) -> Result<Self, Problem> {
        let caller = parts.extensions.get::<Self>().cloned();
        caller.ok_or_else(|| Problem::internal(&"an open route asks who calls"))
    }
}
