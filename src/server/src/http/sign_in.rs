//! Sign-in of pages: browsers send no header with a WebSocket or an image, but they send cookies.

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use super::admission::COOKIE;
use super::app::Shared;
use super::problem::{Code, Problem};
use crate::jobs::Timestamp;
use crate::jobs::access::{Caller, Scopes, Signed};

/// Identity and permissions of the caller.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Caller)]
pub(super) struct CallerView {
    /// Owner of what the caller makes; null for a caller without a key.
    owner: Option<String>,
    /// Permissions of the caller: `read`, `write`, `admin`.
    #[schema(value_type = Vec<crate::jobs::access::Scope>)]
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
    let begins = |name, start: &str| {
        let value = headers.get(name).and_then(|value| value.to_str().ok());
        value.is_some_and(|value| value.starts_with(start))
    };
    begins("origin", "https://") || begins("x-forwarded-proto", "https")
}
