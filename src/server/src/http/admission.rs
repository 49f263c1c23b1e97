//! Authentication of requests by a key, in a header or in the cookie of a signed-in page; scopes; signing in.

use std::sync::Arc;

use axum::Json;
use axum::extract::{FromRequestParts, MatchedPath, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use super::app::{App, Shared};
use super::connections::Peer;
use super::limits::Standing;
use super::problem::{Code, Problem};
use super::upload::drain_refused;
use crate::jobs::Timestamp;
use crate::jobs::access::{Caller, Denied, Scope, Scopes, Signed};

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
    let given = headers.get(header::AUTHORIZATION);
    let bearer = given
        .and_then(|value| value.to_str().ok())
        .and_then(|text| text.split_at_checked(7))
        .filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer "))
        .map(|(_, key)| key.trim());
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

// Scopes required by operations: reading needs `read`, anything else `write`.

/// Path of operations for any key, which concern the key itself.
const OF_ANY_KEY: &str = "/v1/sign-in";
/// Path of an operation that changes something although its method is GET.
const WRITTEN: &str = "/v1/sessions/{id}/live";
/// Paths of operations on things that belong to no owner, which need `admin`.
const OF_ALL: [&str; 3] = ["/v1/drain", "/v1/pause", "/metrics"];

/// Returns the scopes that an operation requires.
pub(super) fn needed(method: &Method, path: &str) -> Vec<Scope> {
    if path == OF_ANY_KEY {
        return Vec::new();
    }
    let is_reading = [Method::GET, Method::HEAD].contains(method) && path != WRITTEN;
    let verb = if is_reading {
        Scope::Read
    } else {
        Scope::Write
    };
    let admin = OF_ALL.contains(&path).then_some(Scope::Admin);
    std::iter::once(verb).chain(admin).collect()
}

// Sign-in of pages: browsers send no header with a WebSocket or an image, but they send cookies.

/// Identity and permissions of the caller.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Caller)]
pub(super) struct CallerView {
    /// Owner of what the caller makes; null for a caller without a key.
    owner: Option<String>,
    /// Permissions of the caller: `read`, `write`, `admin`.
    #[schema(value_type = Vec<Scope>)]
    scopes: Scopes,
    /// `true` if the caller is a page that signed in.
    signed_in: bool,
    /// Time after which the key is refused; null if it has no end.
    #[schema(value_type = Option<String>, format = DateTime)]
    expires_at: Option<Timestamp>,
}

/// Check who calls.
#[utoipa::path(
    get, path = "/v1/sign-in", operation_id = "getCaller", tag = "access",
    responses((status = 200, description = "The caller", body = CallerView))
)]
pub(super) async fn get_caller(caller: Caller) -> Json<CallerView> {
    let key = caller.key();
    Json(CallerView {
        owner: caller.owner().name().map(str::to_owned),
        scopes: caller.scopes().clone(),
        signed_in: key.is_some_and(|key| key.parent.is_some()),
        expires_at: key.and_then(|key| key.expires),
    })
}

/// Sign a page in.
///
/// The answer sets a cookie for the calls of this browser. It stands for the key of the request for
/// 12 hours at most, and ends with it. Scripts cannot read it, other sites cannot use it, and the key
/// is not in it.
#[utoipa::path(
    post, path = "/v1/sign-in", operation_id = "signIn", tag = "access",
    responses(
        (status = 204, description = "The cookie is set", headers(("Set-Cookie" = String, description = "The cookie"))),
        (status = 409, description = "`no_keys`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn sign_in(
    State(app): Shared,
    caller: Caller,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let Some(Signed { text, life }) = app.keys.sign_in(&caller).await? else {
        return Err(Problem::new(Code::NoKeys, "every call is answered"));
    };
    answer(&text.reveal(), life.as_secs(), &headers)
}

/// Sign a page out.
///
/// The cookie is removed and refused from now on. The key that signed in stays valid.
#[utoipa::path(
    delete, path = "/v1/sign-in", operation_id = "signOut", tag = "access",
    responses((status = 204, description = "The cookie is removed", headers(("Set-Cookie" = String, description = "An empty cookie")))),
)]
pub(super) async fn sign_out(
    State(app): Shared,
    caller: Caller,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    app.keys.sign_out(&caller).await?;
    answer("", 0, &headers)
}

/// Sets the cookie. It has no path, so browsers send it to all paths beside this one, whatever prefix a proxy adds.
fn answer(value: &str, seconds: u64, headers: &HeaderMap) -> Result<Response, Problem> {
    let secure = if is_encrypted(headers) {
        "; Secure"
    } else {
        ""
    };
    let cookie = format!("{COOKIE}={value}; HttpOnly; SameSite=Strict; Max-Age={seconds}{secure}");
    let mut cookie = HeaderValue::from_str(&cookie).map_err(|error| Problem::internal(&error))?;
    cookie.set_sensitive(true);
    Ok((StatusCode::NO_CONTENT, [(header::SET_COOKIE, cookie)]).into_response())
}

/// Returns whether the browser reaches the service over TLS, as the headers of browser or proxy tell.
fn is_encrypted(headers: &HeaderMap) -> bool {
    [("origin", "https://"), ("x-forwarded-proto", "https")]
        .into_iter()
        .any(|(name, start)| {
            let value = headers.get(name).and_then(|value| value.to_str().ok());
            value.is_some_and(|value| value.starts_with(start))
        })
}
