//! Who calls: the key that a request carries, in a header or in the cookie of a page that signed in.

use std::sync::Arc;

use axum::extract::{FromRequestParts, MatchedPath, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use axum::middleware::Next;
use axum::response::Response;

use super::problem::{Code, Problem};
use super::scopes::needed;
use super::upload::drain_refused;
use super::{App, Shared};
use crate::jobs::access::{Caller, Denied, Scope};

/// The cookie of pages that signed in.
pub(super) const COOKIE: &str = "unwrapd-key";

/// Lets a request pass if its key is good for it, and says who calls.
pub(super) async fn admit(
    State(app): Shared,
    path: MatchedPath,
    mut request: Request,
    next: Next,
) -> Result<Response, Problem> {
    let needed = needed(request.method(), path.as_str());
    match caller(&app, request.headers(), &needed).await {
        Ok(caller) => {
            request.extensions_mut().insert(caller);
            Ok(next.run(request).await)
        }
        Err(problem) => {
            drain_refused(request).await;
            Err(problem)
        }
    }
}

/// Who calls, if they may do what needs these scopes.
async fn caller(app: &App, headers: &HeaderMap, needed: &[Scope]) -> Result<Caller, Problem> {
    let caller = app.keys.caller(key(headers)).await?;
    match needed.iter().find(|&&it| !caller.scopes().have(it)) {
        None => Ok(caller),
        Some(scope) => {
            let detail = format!("the key does not have the scope `{}`", scope.word());
            Err(Problem::new(Code::MissingScope, detail))
        }
    }
}

/// The key of a request: what says `Bearer`, or else the cookie.
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

/// Whoever was let in.
impl FromRequestParts<Arc<App>> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &Arc<App>) -> Result<Self, Problem> {
        let caller = parts.extensions.get::<Self>().cloned();
        caller.ok_or_else(|| Problem::internal(&"an open route asks who calls"))
    }
}
